// The entry `parsel-runtime`: programs without three.js and without WebAssembly.
export type { GroupView } from '../../src/program/compile';
export type {
  CagePart,
  CageRelation,
  CageShape,
  Corners,
  GroupRelation,
  Layer,
  Program,
  Vec3,
} from '../../src/program/types';
export { embedProgram, readEmbedded, removeEmbedded } from './embed';
export { ParselError } from './error';
export { compile, type Evaluate, type LoadedProgram, loadProgram, type Values } from './program';
export type { SliderParameter } from './values';
