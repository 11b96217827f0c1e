// The cases of program.bench.mjs.
import { checkProgram } from '../../web/src/program/check';
import { compileProgram, type Evaluator } from '../../web/src/program/compile';
import type { Program, Shape, Statement } from '../../web/src/program/types';
import { randomProgram, randomShape } from '../web/random_program';

interface Prepared {
  evaluator: Evaluator;
  layers: number;
  statements: number;
  parts: number;
  checkTime: number;
  compileTime: number;
}

function prepare(shape: Shape, program: Program): Prepared {
  const start = performance.now();
  const checked = checkProgram(program, shape);
  if (!checked.ok) throw new Error(`${checked.error.place}: ${checked.error.cause}`);
  const middle = performance.now();
  const evaluator = compileProgram(checked.value, shape);
  const statements = program.layers.reduce((sum, layer) => sum + layer.statements.length, 0);
  const times = { checkTime: middle - start, compileTime: performance.now() - middle };
  return { evaluator, layers: program.layers.length, statements, parts: shape.parts.length, ...times };
}

function only(program: Program, keep: (statement: Statement) => boolean): Program {
  const layers = program.layers.map((layer) => ({ ...layer, statements: layer.statements.filter(keep) }));
  return { ...program, layers };
}

const loose = randomShape(1, { loose: 100, rows: 0, rings: 0 });
const grouped = randomShape(2, { loose: 70, rows: 3, rings: 3 });
const amount = 0.25;

export const cases = [
  {
    name: '100 parts in one layer',
    prepare: () => prepare(loose, randomProgram(loose, 1, { layers: 1, statements: 200, amount })),
  },
  {
    name: '100 parts in four layers',
    prepare: () => prepare(loose, randomProgram(loose, 2, { layers: 4, statements: 50, amount })),
  },
  {
    name: '103 parts and 6 groups under every operator',
    prepare: () => prepare(grouped, randomProgram(grouped, 3, { layers: 4, statements: 50, amount })),
  },
  {
    name: '103 parts and 6 groups without counts',
    prepare: () =>
      prepare(
        grouped,
        only(randomProgram(grouped, 3, { layers: 4, statements: 50, amount }), ({ op }) => op !== 'change_count'),
      ),
  },
];
