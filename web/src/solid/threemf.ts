// 3MF, core specification 1.3: one object of triangles that share their corners, in millimetres, on the plate.
import { strToU8, zipSync } from 'fflate';
import type { Solid } from './types';

const xml = '<?xml version="1.0" encoding="UTF-8"?>\n';

const contentTypes = `${xml}<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
`;

const relationships = `${xml}<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
`;

/**
 * The same solid gives the same bytes.
 * @param scale of the millimetres
 * @param name of the object
 */
export function writeThreeMf(
  { positions, triangles, low }: Solid,
  scale: number,
  name: string,
): Uint8Array<ArrayBuffer> {
  const digits = 6; // of a millimetre
  const written: string[] = [];
  for (let i = 0; i < positions.length; i += 3) {
    const [x, y, z] = [0, 1, 2].map((k) => number(scale * ((positions[i + k] as number) - (low[k] as number)), digits));
    written.push(`<vertex x="${x}" y="${y}" z="${z}"/>`);
  }
  const faces: string[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = triangles.subarray(i, i + 3);
    faces.push(`<triangle v1="${a}" v2="${b}" v3="${c}"/>`);
  }
  const model = `${xml}<model unit="millimeter" xml:lang="en" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Title">${escaped(name)}</metadata>
<metadata name="Application">ParSEL</metadata>
<resources>
<object id="1" type="model" name="${escaped(name)}"><mesh>
<vertices>
${written.join('\n')}
</vertices>
<triangles>
${faces.join('\n')}
</triangles>
</mesh></object>
</resources>
<build><item objectid="1"/></build>
</model>
`;
  const files = {
    '[Content_Types].xml': strToU8(contentTypes),
    '_rels/.rels': strToU8(relationships),
    '3D/3dmodel.model': strToU8(model),
  };
  return zipSync(files, { mtime: new Date(1980, 0, 1) }) as Uint8Array<ArrayBuffer>;
}

/** The shortest that says the same to so many places. */
const number = (value: number, places: number) => `${Number(value.toFixed(places))}`;

/** XML has no characters below the space but these three. */
const escaped = (text: string) =>
  text
    .replace(/[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\u{10000}-\u{10ffff}]/gu, '')
    .replace(/[&<>"]/g, (sign) => `&#${sign.charCodeAt(0)};`);
