// Proof that the whole chain works: GiNaC solves an equation in the worker, a closure evaluates the closed form at every
// step of the slider, and the scene shows it.
import { useComputed, useSignal, useSignalEffect } from '@preact/signals';
import { compileAmount } from '../program/compile';
import { parseAmount } from '../program/parse';
import { errorMessage } from '../program/types';
import type { Stage } from '../scene/stage';
import { core } from '../session/core';
import { CoreError } from '../worker/client';

/** The plank's length is 1 and its foot is fixed: for its far end to hang over the point 0.6 + x, it must lean by y. */
const equation = 'cos(y) - (0.6 + x)';

type Solution =
  | { kind: 'none' }
  | { kind: 'solved'; text: string; angle: (values: readonly number[]) => number }
  | { kind: 'failed'; text: string };

async function solve(): Promise<Solution> {
  if (core.value.kind !== 'ready') return { kind: 'none' };
  const { result } = await core.value.client.call('solve', { equation, unknown: 'y' });
  for (const text of result.solutions) {
    const parsed = parseAmount(text);
    if (!parsed.ok) return { kind: 'failed', text: errorMessage(parsed.error) };
    const angle = compileAmount(parsed.value, ['x']);
    if (angle([0]) > 0) return { kind: 'solved', text, angle }; // the root that leans upwards
  }
  return { kind: 'failed', text: 'The core found no angle that leans upwards.' };
}

const degrees = (radians: number) => `${((radians * 180) / Math.PI).toFixed(1)}°`;

export function EquationCard({ stage }: { stage: Stage | null }) {
  const x = useSignal(0);
  const solution = useSignal<Solution>({ kind: 'none' });
  const angle = useComputed(() => (solution.value.kind === 'solved' ? solution.value.angle([x.value]) : Number.NaN));

  useSignalEffect(() => {
    if (core.value.kind !== 'ready') return;
    solve().then(
      (found) => {
        solution.value = found;
      },
      (error: unknown) => {
        solution.value = { kind: 'failed', text: error instanceof CoreError ? error.message : String(error) };
      },
    );
  });
  if (Number.isFinite(angle.value)) stage?.setAngle(angle.value);

  return (
    <section class="panel card" aria-labelledby="equation-title">
      <h2 id="equation-title">Lean the plank</h2>
      <p class="quiet">
        Solve <code>{equation} = 0</code> for <code>y</code>:
      </p>
      {solution.value.kind === 'none' && <p>{core.value.kind === 'failed' ? 'No core, no solution.' : 'solving…'}</p>}
      {solution.value.kind === 'failed' && (
        <p class="error" role="alert">
          {solution.value.text}
        </p>
      )}
      {solution.value.kind === 'solved' && (
        <>
          <p>
            <code data-testid="solution">y = {solution.value.text}</code>
          </p>
          <label>
            x = {x.value.toFixed(2)}, y = <span data-testid="angle">{degrees(angle.value)}</span>
            <input
              type="range"
              min={-0.35}
              max={0.35}
              step={0.01}
              value={x.value}
              aria-valuetext={`${x.value.toFixed(2)}: the plank leans by ${degrees(angle.value)}`}
              onInput={(event) => {
                x.value = event.currentTarget.valueAsNumber;
              }}
              onDblClick={() => {
                x.value = 0;
              }}
            />
          </label>
          <p class="quiet">Solved once by GiNaC in a worker; every step of the slider is a JavaScript closure.</p>
        </>
      )}
    </section>
  );
}
