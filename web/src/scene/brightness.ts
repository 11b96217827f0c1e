// How bright a model is on the whole, so that it can be told from the ground that it stands on.
import * as three from 'three';
import type { LoadedModel } from './meshes';

/** Of the materials' own colours and textures, weighted by the size of what they cover: 0 black … 1 white, as seen. */
export function brightnessOf({ meshes }: LoadedModel): number {
  let [sum, weight] = [0, 0];
  const known = new Map<three.Material, number>();
  for (const { mesh } of meshes) {
    mesh.geometry.boundingBox ?? mesh.geometry.computeBoundingBox();
    const size = (mesh.geometry.boundingBox ?? new three.Box3()).getSize(new three.Vector3());
    const area = (size.x * size.y + size.y * size.z + size.z * size.x) * mesh.matrixWorld.getMaxScaleOnAxis() ** 2;
    for (const material of [mesh.material].flat()) {
      const brightness = known.get(material) ?? brightnessOfMaterial(material);
      known.set(material, brightness);
      sum += area * brightness;
      weight += area;
    }
  }
  return weight > 0 ? sum / weight : 0.5;
}

function brightnessOfMaterial(material: three.Material): number {
  const { color, map } = material as three.MeshStandardMaterial;
  if (!(color instanceof three.Color)) return 0.5;
  const { r, g, b } = color;
  return (0.2126 * r + 0.7152 * g + 0.0722 * b) ** (1 / 2.2) * (map ? brightnessOfTexture(map) : 1);
}

const texels = 8;
function brightnessOfTexture({ image }: three.Texture): number {
  const context = Object.assign(document.createElement('canvas'), { width: texels, height: texels }).getContext('2d');
  try {
    context?.drawImage(image as CanvasImageSource, 0, 0, texels, texels);
    const data = context?.getImageData(0, 0, texels, texels).data ?? [];
    let sum = 0;
    for (let i = 0; i < data.length; i += 4)
      sum += 0.2126 * (data[i] ?? 0) + 0.7152 * (data[i + 1] ?? 0) + 0.0722 * (data[i + 2] ?? 0);
    return sum / 255 / texels ** 2;
  } catch {
    return 1; // no picture: nothing that darkens the colour
  }
}
