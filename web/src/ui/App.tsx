// The page: the stage, and the card of the one equation that runs through the whole chain.
import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { createStage, type Stage } from '../scene/stage';
import { core } from '../session/core';
import { EquationCard } from './EquationCard';

export function App() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const stage = useSignal<Stage | null>(null);

  useEffect(() => {
    if (canvas.current === null) return;
    const created = createStage(canvas.current);
    stage.value = created;
    return () => created.dispose();
  }, [stage]);

  return (
    <>
      <canvas ref={canvas} class="stage" aria-label="A plank that leans on the ground" role="img" />
      <header class="panel bar">
        <h1>ParSEL</h1>
        <span class="quiet" role="status">
          {core.value.kind === 'starting' && 'starting the core…'}
          {core.value.kind === 'ready' && `core ${core.value.version}, ready`}
          {core.value.kind === 'failed' && core.value.text}
        </span>
      </header>
      <main>
        <EquationCard stage={stage.value} />
      </main>
    </>
  );
}
