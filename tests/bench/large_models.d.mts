export function ballsOf(balls: number, rings: number): Buffer;
export function scan(rings?: number): Buffer;
export function dust(count: number): Buffer;
export function pointCloud(count?: number): Buffer;
export function oneMesh(positions: Float32Array, triangles: Uint32Array, mode?: number): Buffer;
