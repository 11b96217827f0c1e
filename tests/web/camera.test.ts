// The camera keeps a growing model in the part of the canvas that no panel covers, unless a person has moved it.
import * as three from 'three';
import { beforeEach, describe, expect, it } from 'vitest';
import { CameraRig } from '../../web/src/scene/camera';

const [width, height] = [1440, 900];
const insets = { left: 256, right: 352, top: 72, bottom: 150 };
const boxOf = (x: number, y: number, z: number) =>
  new three.Box3(new three.Vector3(-x, -y, -z), new three.Vector3(x, y, z));
const small = boxOf(0.4, 0.6, 0.4);

let rig: CameraRig;
/** As frames do, until nothing moves. */
const settle = () => {
  let frames = 0;
  while (rig.update(1 / 60)) if (++frames > 600) throw new Error('the camera never comes to rest');
  rig.camera.updateMatrixWorld();
};
/** CSS pixels in the canvas of all corners of a box. */
const onCanvas = ({ min, max }: three.Box3) =>
  Array.from({ length: 8 }, (_, k) => {
    const corner = new three.Vector3(k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z);
    const { x, y } = corner.project(rig.camera);
    return { x: ((x + 1) / 2) * width, y: ((1 - y) / 2) * height };
  });
const isInFreePart = (box: three.Box3) =>
  onCanvas(box).every(
    ({ x, y }) => x >= insets.left && x <= width - insets.right && y >= insets.top && y <= height - insets.bottom,
  );

/** The controls make one, and fill it only where they have an element. */
Object.assign(globalThis, { DOMRect: class {} });

beforeEach(() => {
  // Without an element there is nothing to drag on; all else is as on the page.
  rig = new CameraRig(undefined as unknown as HTMLCanvasElement, false);
  rig.resize(width, height, insets);
  rig.fit(small.getBoundingSphere(new three.Sphere()), false, true);
  settle();
});

describe('a model that grows', () => {
  it.each([
    ['wide', boxOf(3, 0.6, 0.4)],
    ['high', new three.Box3(new three.Vector3(-0.4, -0.6, -0.4), new three.Vector3(0.4, 2.6, 0.4))],
    ['deep', boxOf(0.4, 0.6, 3)],
  ] as const)('%s stays in the free part, and the camera comes back with it', (_, grown) => {
    const before = rig.pose;
    const position = rig.camera.position.clone();
    expect(isInFreePart(small)).toBe(true);
    expect(isInFreePart(grown)).toBe(false);
    rig.keepFramed(small, grown);
    settle();
    expect(isInFreePart(grown)).toBe(true);
    expect(rig.isFramed).toBe(true);
    rig.keepFramed(small, small);
    settle();
    expect(rig.pose).toEqual(before);
    expect(rig.camera.position.distanceTo(position)).toBeLessThan(1e-9);
  });

  it('is followed after the view was turned, from where it is seen then', () => {
    rig.look('left', false);
    rig.keepFramed(small, boxOf(0.4, 0.6, 3));
    settle();
    expect(isInFreePart(boxOf(0.4, 0.6, 3))).toBe(true);
    expect(rig.pose.slice(0, 2)).toEqual([1.571, 1.571]);
  });
});

describe('a view of a person’s own', () => {
  it.each([
    ['zoomed', () => rig.zoom(0.7)],
    ['taken from a link', () => (rig.pose = [0.3, 1, 5, 0.1, 0, 0])],
    ['of one part', () => rig.fit(new three.Sphere(new three.Vector3(0.2, 0, 0), 0.2), false, false)],
  ] as const)('%s is left alone', (_, act) => {
    act();
    settle();
    const own = rig.pose;
    expect(rig.isFramed).toBe(false);
    rig.keepFramed(small, boxOf(3, 3, 3));
    settle();
    expect(rig.pose).toEqual(own);
  });
});

describe('panels', () => {
  const middle = () => onCanvas(boxOf(0, 0, 0))[0]?.y ?? 0;
  const between = (bottom: number) => (insets.top + height - bottom) / 2;
  const taller = { ...insets, bottom: 350 };

  it('that come or grow move what is between them there, not at once', () => {
    expect(middle()).toBeCloseTo(between(insets.bottom), 3);
    rig.resize(width, height, taller);
    rig.camera.updateMatrixWorld();
    expect(middle()).toBeCloseTo(between(insets.bottom), 3);
    expect(rig.update(1 / 60)).toBe(true);
    expect(middle()).toBeLessThan(between(insets.bottom) - 5);
    expect(middle()).toBeGreaterThan(between(taller.bottom) + 5);
    settle();
    expect(middle()).toBeCloseTo(between(taller.bottom), 3);
  });

  it('that come with a model are where they are when it is first seen', () => {
    rig.fit(small.getBoundingSphere(new three.Sphere()), false, true);
    rig.update(1 / 60);
    rig.resize(width, height, taller);
    expect(middle()).toBeCloseTo(between(taller.bottom), 3);
    rig.fit(small.getBoundingSphere(new three.Sphere()), true, true);
    rig.update(1 / 60);
    rig.camera.updateMatrixWorld();
    expect(isInFreePart(small)).toBe(true);
  });

  it('that cover nearly all leave a little for the model', () => {
    rig.resize(width, height, { ...insets, bottom: 2 * height });
    settle();
    expect(middle()).toBeCloseTo(insets.top + 40, 3);
  });
});
