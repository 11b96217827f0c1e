// The edited model as one solid for a 3D printer: how large it is and becomes, and what of it is no solid.

import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { editedName } from '../session/download_names';
import { gapSentences } from '../session/gaps';
import { document, notice, run, selected, task } from '../session/session';
import { unitedParts, writtenSolid } from '../session/solid';
import { number, t } from '../texts/texts';
import { dialog, download, editedFile, modelName } from './actions';
import { Dialog } from './Dialog';

type Made = NonNullable<Awaited<ReturnType<typeof make>>>;

interface How {
  /** Of the selected parts alone. */
  readonly chosen: boolean;
  readonly closeGaps: boolean;
  readonly leaveOut: boolean;
}

async function make({ chosen, closeGaps, leaveOut }: How) {
  const { model, unit } = document.peek();
  if (model === null) return null;
  return run(t`Making one solid`, async (options) => {
    const file = await editedFile(chosen ? 'selected' : 'all', closeGaps, options);
    options.signal.throwIfAborted();
    if (file === null) return null;
    const united = await unitedParts(file.glb, model.shape, leaveOut, options);
    return { ...united, gaps: gapSentences(file, model.shape, unit) };
  });
}

export function PrintDialog() {
  const made = useSignal<Made | null>(null);
  const how = useSignal<How>({ chosen: false, closeGaps: false, leaveOut: false });
  const longest = useSignal<number | null>(null); // millimetres; null: as it is
  const start = async (change: Partial<How>) => {
    how.value = { ...how.peek(), leaveOut: false, ...change };
    const asked = how.peek();
    made.value = null;
    const found = await make(asked);
    if (how.peek() === asked) made.value = found;
  };
  useEffect(() => void start({}), []);
  const close = () => {
    task.peek()?.cancel();
    dialog.value = null;
  };
  const hasEdits = document.value.layers.some(({ enabled }) => enabled);
  const solid = made.value?.solid ?? null;
  const faults = made.value?.faults ?? [];
  const size = solid === null ? [] : solid.high.map((x, i) => x - (solid.low[i] ?? 0));
  const scale = longest.value === null ? 1 : longest.value / Math.max(...size);
  const save = async (format: 'stl' | '3mf') => {
    if (solid === null) return;
    const name = editedName(modelName());
    const bytes = await run(t`Writing the file`, (options) =>
      writtenSolid(solid, { format, scale, name: modelName() }, options),
    );
    if (bytes !== null) download(`${name}.${format}`, new Blob([bytes], { type: `model/${format}` }));
  };
  const fault = notice.value?.kind === 'error' ? notice.value.text : '';
  return (
    <Dialog title={t`For printing`} class="print" onClose={close}>
      <p class="quiet">
        {t`The model as it is edited, all parts as one watertight solid, in millimetres. Inner walls where parts overlap are gone.`}
      </p>
      {selected.value.length > 0 && (
        <label class="check">
          <input
            type="checkbox"
            checked={how.value.chosen}
            onChange={(event) => void start({ chosen: event.currentTarget.checked })}
          />
          <span>{selected.value.length === 1 ? t`The selected part only` : t`The selected parts only`}</span>
        </label>
      )}
      {hasEdits && (
        <label class="check">
          <input
            type="checkbox"
            checked={how.value.closeGaps}
            onChange={(event) => void start({ closeGaps: event.currentTarget.checked })}
          />
          <span>{t`Close gaps: parts that the edits have pulled apart grow until they meet`}</span>
        </label>
      )}
      {made.value !== null && made.value.gaps !== '' && <p class="quiet">{made.value.gaps}</p>}
      <Faults faults={faults} turned={made.value?.turned ?? []} leftOut={solid !== null} />
      {solid === null && faults.length > 0 && (
        <button type="button" class="button" onClick={() => void start({ leaveOut: true })}>
          {faults.length === 1 ? t`Leave it out` : t`Leave them out`}
        </button>
      )}
      {solid !== null && (
        <>
          <dl class="facts">
            <dt>{t`Size`}</dt>
            <dd>{size.map((x) => millimetres(x * scale)).join(' × ')} mm</dd>
            <dt>{t`Volume`}</dt>
            <dd>{volume(solid.volume * scale ** 3)}</dd>
            <dt>{t`Triangles`}</dt>
            <dd>{number(solid.triangles.length / 3)}</dd>
          </dl>
          {solid.pieces > 1 && (
            <p class="quiet">
              {t`It is in ${solid.pieces} pieces: nothing joins them. What should touch may stand a hair apart.`}
            </p>
          )}
          <label class="field">
            <span>{t`Longest side`}</span>
            <input
              type="number"
              min={0.1}
              step="any"
              value={Number((scale * Math.max(...size)).toFixed(1))}
              onChange={(event) => {
                const length = event.currentTarget.valueAsNumber;
                longest.value = length > 0 ? length : null;
              }}
            />
            <span class="quiet">{`mm, ${ratio(scale)}`}</span>
          </label>
        </>
      )}
      <p role="status" class={fault === '' ? 'quiet' : 'broken'}>
        {task.value?.text ?? fault}
      </p>
      <div class="row">
        {(['stl', '3mf'] as const).map((format) => (
          <button
            key={format}
            type="button"
            class={`button ${format === '3mf' ? 'primary' : ''}`}
            disabled={solid === null || task.value !== null}
            onClick={() => void save(format)}
          >
            {t`Save ${format.toUpperCase()}`}
          </button>
        ))}
        {task.value !== null && (
          <button type="button" class="button" onClick={() => task.peek()?.cancel()}>
            {t`Cancel`}
          </button>
        )}
      </div>
    </Dialog>
  );
}

const mostNamed = 8;

function Faults({ faults, turned, leftOut }: Pick<Made, 'faults' | 'turned'> & { leftOut: boolean }) {
  if (faults.length === 0 && turned.length === 0) return null;
  const more = faults.length - mostNamed;
  return (
    <>
      {faults.length > 0 && (
        <div class={leftOut ? 'quiet' : 'broken'}>
          <p>
            {leftOut ? t`Left out, because they bound no solid:` : t`Nothing was made, because these bound no solid:`}
          </p>
          <ul class="pitfalls">
            {faults.slice(0, mostNamed).map(({ name, text }, i) => (
              <li key={i}>
                {name} {text}.
              </li>
            ))}
            {more > 0 && <li>{t`And ${more} more.`}</li>}
          </ul>
        </div>
      )}
      {turned.length > 0 && <p class="quiet">{t`Turned right side out: ${[...new Set(turned)].join(', ')}.`}</p>}
    </>
  );
}

const millimetres = (x: number) => (x >= 100 ? number(x, 0, 0) : number(x, 1, 1));
const volume = (cubic: number) =>
  cubic >= 1000
    ? `${number(Number((cubic / 1000).toPrecision(4)))} cm³`
    : `${number(Number(cubic.toPrecision(3)))} mm³`;
/** "1 : 5", of what is made to the model. */
const ratio = (scale: number) =>
  scale <= 1 ? `1 : ${Number((1 / scale).toPrecision(3))}` : `${Number(scale.toPrecision(3))} : 1`;
