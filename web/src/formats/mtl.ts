// Materials of an OBJ. three's MTLLoader reads the lines; what glTF has no place for (ambient, specular and bump maps) is
// left out. Pictures go into the GLB as the bytes that they are: a browser that wrote them anew would write others than the
// next one, and links find a model by the hash of its bytes.
import { MTLLoader } from 'three/examples/jsm/loaders/MTLLoader.js';
import { type Companions, textureOf } from './companions';
import { decodeText, linear, plainSurface, rounded, type Surface, type Texture } from './model';
import { printable } from './names';

type Info = MTLLoader.MaterialCreator['materialsInfo'][string];

export interface Materials {
  /** Plain where the name is unknown. The same object for the same name. */
  surface(name: string): Surface;
  /** How a material lays its picture: times `scale`, plus `offset`, with v upwards. */
  placing(name: string): Placing | null;
}

interface Placing {
  readonly scale: readonly [number, number];
  readonly offset: readonly [number, number];
}

interface Known {
  readonly surface: Surface;
  readonly placing: Placing | null;
}

/** @param libraries the .mtl files that the OBJ names, @param remarks takes what is missing */
export function readMaterials(libraries: readonly Uint8Array[], companions: Companions, remarks: string[]): Materials {
  const known = new Map<string, Known>();
  const missing = new Set<string>();
  const left = new Set<string>();
  const pictures = new Map<string, Texture | null>();

  const pictureOf = (reference: string): Texture | null => {
    const ready = pictures.get(reference);
    if (ready !== undefined) return ready;
    const last = reference.split(/\s+/).at(-1) ?? ''; // after options that the loader does not know
    const bytes = companions.find(reference) ?? companions.find(last);
    const texture = bytes === undefined ? null : textureOf(bytes);
    if (bytes === undefined) missing.add(printable(reference));
    else if (texture === null) left.add(printable(reference));
    pictures.set(reference, texture);
    return texture;
  };

  for (const library of libraries) {
    // Spelt with a sign in front, since names come from anywhere and land in a plain object: "__proto__" is one.
    const text = decodeText(library).replace(/^[ \t]*newmtl[ \t]+/gim, 'newmtl =');
    const creator = new MTLLoader().parse(text, '');
    for (const [key, info] of Object.entries(creator.materialsInfo)) {
      const name = key.slice(1);
      if (!key.startsWith('=') || known.has(name)) continue;
      const map = info.map_kd ? creator.getTextureParams(info.map_kd, {}) : null;
      const texture = map === null ? null : pictureOf(map.url);
      const placing = map === null ? null : { scale: map.scale.toArray(), offset: map.offset.toArray() };
      known.set(name, { surface: surfaceOf(name, info, texture), placing });
    }
  }
  if (missing.size > 0) remarks.push(`Not among the files: ${list(missing)}; drop them together with the model.`);
  if (left.size > 0) remarks.push(`Left out: ${list(left)}, since a GLB holds PNG and JPEG pictures alone.`);
  const plain = new Map<string, Surface>();
  return {
    surface(name) {
      const surface = known.get(name)?.surface ?? plain.get(name) ?? { ...plainSurface, name };
      if (!known.has(name)) plain.set(name, surface);
      return surface;
    },
    placing: (name) => known.get(name)?.placing ?? null,
  };
}

const list = (names: ReadonlySet<string>) =>
  [...names].slice(0, 3).join(', ') + (names.size > 3 ? ` and ${names.size - 3} more` : '');

/** A number of a line, or null when there is none. */
function numberOf(value: unknown): number | null {
  const number = typeof value === 'string' ? Number.parseFloat(value) : Number.NaN;
  return Number.isFinite(number) ? number : null;
}

const unit = (value: number) => Math.min(Math.max(value, 0), 1);

function surfaceOf(name: string, info: Info, texture: Texture | null): Surface {
  const color = (value: readonly number[] | undefined) => {
    const isWhole = value?.length === 3 && value.every(Number.isFinite);
    return isWhole ? (value.map(linear) as [number, number, number]) : null;
  };
  const own = color(info.kd);
  const isBlack = own?.every((channel) => channel === 0) ?? true; // exporters write 0 beside a picture that says it all
  const diffuse = texture !== null && isBlack ? ([1, 1, 1] as const) : (own ?? plainSurface.color);
  const dissolve = numberOf(info.d) ?? 1 - (numberOf(info.tr) ?? 0);
  const shininess = numberOf(info.ns);
  return {
    name,
    color: [diffuse[0], diffuse[1], diffuse[2], unit(dissolve)],
    emissive: color(info.ke) ?? [0, 0, 0],
    // As Blender's importer has it: Ns from 0 to 1000 is the square of what is not rough.
    roughness: shininess === null ? 1 : rounded(1 - Math.sqrt(unit(shininess / 1000))),
    texture,
  };
}
