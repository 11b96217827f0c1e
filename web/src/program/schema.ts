// The structure of `parsel/program` v1 as a strict schema: every key is known, every list bounded, every number finite.
import * as v from 'valibot';
import { fieldsOf, geometricOperators, groupOperators } from './operators';
import { isParameterName } from './parse';
import {
  anchors,
  type DirectionReference,
  type Layer,
  type LocalTriple,
  type PointReference,
  type Program,
  type Sign,
  type Statement,
  type Vec3,
  whyKinds,
} from './types';

/**
 * What a program may have at most: ProgramLimits of core/edit/program.h. Untrusted input is refused beyond it, before
 * anything is done with it.
 */
export const limits = {
  layers: 100,
  /** In all layers together. */
  statements: 10_000,
  /** Of a layer: one for each relation that an edit may touch. */
  reports: 100_000,
  /** That a sampled report may speak of. */
  samples: 1_000_000,
  /** That a statement names as its reason. */
  reasons: 256,
  /** Texts are measured in bytes of UTF-8. */
  nameLength: 200,
  requestLength: 4096,
  parameterLength: 64,
  coordinate: 1e6,
  /** JSON values of any kind, and how deep they nest: enough for every program within the limits above. */
  jsonValues: 1_000_000,
  jsonDepth: 16,
} as const;

/** A literal direction shorter than this has no direction. */
const shortest = 1e-9;

// A lone surrogate has no UTF-8, so such a text could not be written back.
const text = v.pipe(
  v.string(),
  v.check((value) => !/\p{Surrogate}/u.test(value), 'Invalid text: Expected Unicode without lone surrogates'),
);
const name = v.pipe(text, v.minLength(1), v.maxBytes(limits.nameLength));
const finite = v.pipe(v.number(), v.finite());
const coordinate = v.pipe(finite, v.minValue(-limits.coordinate), v.maxValue(limits.coordinate));
export const vector: v.GenericSchema<unknown, Vec3> = v.strictTuple([coordinate, coordinate, coordinate]);
const sign: v.GenericSchema<unknown, Sign> = v.picklist([-1, 0, 1]);
const triple: v.GenericSchema<unknown, LocalTriple> = v.strictTuple([sign, sign, sign]);

const partPoint = v.strictObject({ part: name, at: triple });
const partAxis = v.strictObject({ part: name, axis: v.picklist([0, 1, 2]) });
// Not v.union: its messages would only say that no form fits.
const point: v.GenericSchema<unknown, PointReference> = v.lazy((input) => (Array.isArray(input) ? vector : partPoint));
const unit = v.pipe(
  vector,
  v.check(([x, y, z]) => Math.hypot(x, y, z) > shortest, 'Invalid direction: Expected a length above 0'),
);
const direction: v.GenericSchema<unknown, DirectionReference> = v.lazy((input) =>
  Array.isArray(input) ? unit : partAxis,
);

const why = v.strictObject({
  kind: v.picklist(whyKinds),
  relations: v.optional(v.pipe(v.array(name), v.maxLength(limits.reasons)), []),
});
const reason = { why: v.exactOptional(why) };
const geometric = { part: name, feature: v.optional(triple, [0, 0, 0]), amount: v.string(), ...reason };
const group = { relation: name, anchor: v.optional(v.picklist(anchors), 'middle'), amount: v.string(), ...reason };
const kinds = { point, direction };

// Its type is said by types.ts: of a table only tests can tell that it says the same (tests/web/operators.test.ts).
const statement = v.variant('op', [
  ...geometricOperators.map((op) => {
    const own = Object.entries(fieldsOf(op)).map(([field, kind]) => [field, kinds[kind]]);
    return v.strictObject({ op: v.literal(op), ...geometric, ...Object.fromEntries(own) });
  }),
  ...groupOperators.map((op) => v.strictObject({ op: v.literal(op), ...group })),
  v.strictObject({ op: v.literal('keep_fixed'), part: name, ...reason }),
]) as unknown as v.GenericSchema<unknown, Statement>;

const parameter = v.strictObject({
  name: v.pipe(
    v.string(),
    v.maxLength(limits.parameterLength),
    v.check(isParameterName, 'Invalid name: Expected lower-case letters, digits and _, no function name'),
  ),
  min: finite,
  max: finite,
  value: finite,
});

const report = v.pipe(
  v.strictObject({
    id: name,
    status: v.picklist(['held', 'broken', 'disabled']),
    worst: v.pipe(finite, v.minValue(0)),
    proof: v.picklist(['certified', 'sampled']),
    samples: v.exactOptional(v.pipe(finite, v.integer(), v.minValue(1), v.maxValue(limits.samples))),
  }),
  v.check(
    ({ proof, samples }) => samples === undefined || proof === 'sampled',
    'Invalid report: Expected samples of a sampled one only',
  ),
);

/** One layer, such as is read alone where the others are damaged. */
export const layerSchema: v.GenericSchema<unknown, Layer> = v.strictObject({
  request: v.pipe(text, v.maxBytes(limits.requestLength)),
  parameter,
  statements: v.pipe(v.array(statement), v.maxLength(limits.statements)),
  relations: v.optional(v.pipe(v.array(report), v.maxLength(limits.reports)), []),
});

/** Structure only: what the names mean is checked against a shape in check.ts. */
export const programSchema: v.GenericSchema<unknown, Program> = v.strictObject({
  format: v.literal('parsel/program'),
  version: v.literal(1),
  shape: v.strictObject({
    name: v.pipe(text, v.maxBytes(limits.nameLength)),
    sha256: v.pipe(v.string(), v.regex(/^[0-9a-f]{0,64}$/)),
  }),
  layers: v.pipe(v.array(layerSchema), v.maxLength(limits.layers)),
});
