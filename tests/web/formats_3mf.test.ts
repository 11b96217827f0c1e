// 3MF as a GLB.
import { strToU8, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import { boundsOf, meshXml, namesIn, opened, refusal, shapeOf, threeMf } from './format_samples';

describe('3MF', () => {
  const leg = `<object id="1" name="leg">${meshXml([1, 1, 10])}</object>`;
  const at = (x: number, id = 1) => `<component objectid="${id}" transform="1 0 0 0 1 0 0 0 1 ${x} 0 0"/>`;

  it.each([
    ['millimeter', 0.01],
    ['micron', 1e-5],
    ['inch', 0.254],
    ['meter', 10],
  ])('in %s', async (unit, height) => {
    const { gltf } = await opened({ 'a.3mf': threeMf(leg, '<item objectid="1"/>', `unit="${unit}"`) });
    const scale = gltf.nodes.find(({ children }) => children !== undefined)?.scale ?? [1, 1, 1];
    expect(10 * (scale[2] as number)).toBeCloseTo(height, 10);
  });

  it('places components, instances sharing one mesh', async () => {
    const table = `${leg}<object id="2" name="legs"><components>${at(0)}${at(20)}${at(40)}</components></object>`;
    const { gltf, glb } = await opened({ 'a.3mf': threeMf(table, '<item objectid="2"/>') });
    expect(gltf.meshes.length).toBe(1);
    expect(gltf.nodes.filter(({ mesh }) => mesh === 0).map(({ name }) => name)).toEqual(['leg', 'leg', 'leg']);
    const { min, max } = boundsOf(shapeOf(glb));
    expect((max[0] as number) - (min[0] as number)).toBeCloseTo(0.041, 3);
  });

  it('calls a nameless object after the one around it, else after the file', async () => {
    const inner = `<object id="1">${meshXml([1, 1, 10])}</object>`;
    const outer = `${inner}<object id="2" name="post"><components>${at(0)}</components></object>`;
    expect(await namesIn({ 'a.3mf': threeMf(outer, '<item objectid="2"/>') })).toEqual(['post']);
    expect(await namesIn({ 'post box.3mf': threeMf(inner, '<item objectid="1"/>') })).toEqual(['post box']);
  });

  it('moves corners where a transform slants, which no node of glTF can', async () => {
    const { gltf } = await opened({
      'a.3mf': threeMf(leg, '<item objectid="1" transform="1 0 0 0 1 0 0.5 0 1 0 0 0"/>'),
    });
    const position = gltf.meshes[0]?.primitives[0]?.attributes['POSITION'] ?? -1;
    expect(gltf.accessors[position]?.max).toEqual([6, 1, 10]);
  });

  it('has one colour for an object, or those of its corners', async () => {
    const colors =
      '<basematerials id="9"><base name="r" displaycolor="#FF0000"/><base name="g" displaycolor="#00FF00FF"/></basematerials>';
    const one = `${colors}<object id="1" name="leg" pid="9" pindex="1">${meshXml([1, 1, 1])}</object>`;
    const { gltf } = await opened({ 'a.3mf': threeMf(one, '<item objectid="1"/>') });
    expect(gltf.materials[0]?.pbrMetallicRoughness['baseColorFactor']).toEqual([0, 1, 0, 1]);
    const several = `${colors}<object id="1" name="leg" pid="9" pindex="1">${meshXml([1, 1, 1], (i) => (i < 3 ? ' pid="9" p1="0"' : ''))}</object>`;
    const painted = await opened({ 'a.3mf': threeMf(several, '<item objectid="1"/>') });
    expect(painted.gltf.meshes[0]?.primitives.length).toBe(1);
    expect(Object.keys(painted.gltf.meshes[0]?.primitives[0]?.attributes ?? {}).sort()).toEqual([
      'COLOR_0',
      'POSITION',
    ]);
  });

  it('reads objects in files of their own', async () => {
    const other = `<model xmlns="x"><resources>${leg}</resources></model>`;
    const outer =
      '<object id="5" name="frame"><components><component p:path="/3D/Objects/a.model" objectid="1"/></components></object>';
    const file = threeMf(
      outer,
      '<item objectid="5"/>',
      'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06" requiredextensions="p"',
      { '3D/Objects/a.model': other },
    );
    expect(await namesIn({ 'a.3mf': file })).toEqual(['leg']);
  });

  const doubled = Array.from(
    { length: 30 },
    (_, i) => `<object id="${i + 2}"><components>${at(0, i + 1)}${at(1, i + 1)}</components></object>`,
  ).join('');
  const item = '<item objectid="1"/>';
  it.each([
    ['no archive', 'hello', /is no archive that can be unpacked/],
    ['no model in it', zipSync({ 'a.txt': strToU8('x') }), /is no 3MF/],
    ['nothing on the plate', threeMf(leg, ''), /nothing in it is placed on the plate/],
    ['an object that is not there', threeMf(leg, '<item objectid="7"/>'), /places object 7, which it lacks/],
    [
      'an object in itself',
      threeMf(`<object id="1"><components>${at(0)}</components></object>`, item),
      /object 1 contains itself/,
    ],
    ['billions of objects', threeMf(leg + doubled, '<item objectid="31"/>'), /more than 20,000 objects/],
    [
      'a document type',
      zipSync({ '3D/a.model': strToU8('<!DOCTYPE m [<!ENTITY a SYSTEM "file:///etc/passwd">]><model/>') }),
      /document type/,
    ],
    [
      'an unknown extension',
      threeMf(
        leg,
        item,
        'xmlns:b="http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02" requiredextensions="b"',
      ),
      /needs the extension .*beamlattice/,
    ],
    ['an unknown unit', threeMf(leg, item, 'unit="cubit"'), /measures in “cubit”/],
    [
      'a transform of eleven numbers',
      threeMf(leg, '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0"/>'),
      /not twelve numbers/,
    ],
    [
      'vertices that are not there',
      threeMf(leg.replace('v1="0"', 'v1="99"'), item),
      /object leg is damaged: triangle 0 has vertex 99 of 8/,
    ],
    [
      'XML that is not closed',
      threeMf(`<object id="1" name="x">${meshXml([1, 1, 1])}`, item),
      /line 1: the XML is damaged at <\/resources>/,
    ],
  ])('is refused: %s', async (_, content, sentence) => {
    expect(await refusal({ 'a.3mf': content })).toMatch(sentence);
  });
});
