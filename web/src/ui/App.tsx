// The page: the stage fills the window, panels float on it.

import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { useEffect, useLayoutEffect } from 'preact/hooks';
import type { Insets } from '../scene/camera';
import { cutting } from '../session/cutting';
import { readDropped } from '../session/files';
import { lookOnOpening } from '../session/page_offers';
import { document } from '../session/session';
import { suggestions } from '../session/suggestions';
import { t } from '../texts/texts';
import { ApartSlider } from './ApartSlider';
import { dialog, openAny } from './actions';
import { Compass } from './Compass';
import { Composer } from './Composer';
import { CutCard, CutHandle } from './CutCard';
import { Dimensions } from './Dimensions';
import { FirstScreen } from './FirstScreen';
import { isEmbedded } from './frame';
import { Handles } from './Handles';
import { Icon } from './Icon';
import { LayerCard } from './LayerCard';
import { Licences } from './Licences';
import {
  ExploreDialog,
  HelpDialog,
  ModelDialog,
  PrintDialog,
  ProgramDialog,
  ReadingsDialog,
  ShareDialog,
} from './late_dialogs';
import { OpenDialog } from './OpenDialog';
import { PartsPanel } from './PartsPanel';
import { PlaceOffer } from './PlaceCard';
import { RightPanel } from './RightPanel';
import { rich } from './rich';
import { SplitOffer } from './SplitCard';
import { StageView } from './StageView';
import { StatusLine } from './StatusLine';
import { listenForShortcuts } from './shortcuts';
import { RulerCard, Tools } from './Tools';
import { TopBar } from './TopBar';
import { Tour, TourOffer } from './Tour';
import { welcome } from './welcome';
import { coveredBelow, measure, useStandsBelow } from './window_bottom';
import type { FeatureKind } from './words';

const phone = matchMedia('(max-width: 720px)');

export function App() {
  const isPhone = useSignal(phone.matches);
  const partsOpen = useSignal(true);
  const editsOpen = useSignal(true);
  const tab = useSignal<'edits' | 'parts'>('edits');
  const pickKind = useSignal<FeatureKind | null>(null);
  const dropping = useSignal(false);

  useEffect(() => {
    const stops = [listenForShortcuts(), welcome(), lookOnOpening(), listenForDrops((over) => (dropping.value = over))];
    const onChange = () => {
      isPhone.value = phone.matches;
    };
    phone.addEventListener('change', onChange);
    return () => {
      for (const stop of stops) stop();
      phone.removeEventListener('change', onChange);
    };
  }, [dropping, isPhone]);

  const suggested = suggestions.asked.value?.stop;
  useEffect(() => {
    if (suggested === undefined) return;
    editsOpen.value = true;
    tab.value = 'edits';
  }, [suggested, editsOpen, tab]);

  const centre = useStandsBelow({ passing: '.status-line' });
  useLayoutEffect(measure); // the sheet lifts them, or lets them down
  if (isEmbedded) return <Embedded />;
  const bottom = coveredBelow.value + 8;
  const insets: Insets = isPhone.value
    ? { left: 0, right: 0, top: 56, bottom }
    : { left: partsOpen.value ? 256 : 0, right: editsOpen.value ? 352 : 0, top: 72, bottom };
  const edits = <RightPanel pickKind={pickKind} />;
  const parts = (
    <PartsPanel
      onEdit={() => {
        pickKind.value ??= 'whole';
        editsOpen.value = true;
        tab.value = 'edits';
      }}
    />
  );
  return (
    <div class={`app ${isPhone.value ? 'phone' : ''}`}>
      <StageView insets={insets} pickKind={pickKind} />
      <Compass right={insets.right} />
      {cutting.value === null ? <Handles /> : <CutHandle />}
      <FirstScreen />
      <TopBar />
      <main>
        {isPhone.value ? (
          <Sheet tab={tab} open={editsOpen}>
            {tab.value === 'edits' ? edits : parts}
          </Sheet>
        ) : (
          <>
            <SidePanel title={t`Parts`} side="left" open={partsOpen}>
              {parts}
            </SidePanel>
            <SidePanel title={t`Edits`} side="right" open={editsOpen}>
              {edits}
            </SidePanel>
          </>
        )}
        <div
          ref={centre}
          class={`centre ${editsOpen.value ? '' : 'low'}`}
          style={{ paddingLeft: `${insets.left + 12}px`, paddingRight: `${insets.right + 12}px` }}
        >
          {cutting.value === null && <TourOffer />}
          <SplitOffer />
          <PlaceOffer />
          <CutCard />
          <RulerCard />
          <StatusLine />
          <div class="row">
            <Dimensions />
            <Tools />
            <ApartSlider />
          </div>
          <Composer picking={pickKind.value !== null} />
        </div>
      </main>
      {!isPhone.value && (
        <footer class="foot quiet">
          <p>
            {rich(t`After <a>ParSEL</a>, Ganeshan et al. 2024`, {
              a: (text) => <a href="https://arxiv.org/abs/2405.20319">{text}</a>,
            })}
          </p>
          <Licences />
        </footer>
      )}
      <Tour />
      {dialog.value === 'open' && <OpenDialog />}
      {dialog.value === 'share' && <ShareDialog />}
      {dialog.value === 'help' && <HelpDialog />}
      {dialog.value === 'text' && <ProgramDialog />}
      {dialog.value === 'model' && <ModelDialog />}
      {dialog.value === 'print' && <PrintDialog />}
      {dialog.value === 'explore' && <ExploreDialog />}
      {dialog.value === 'readings' && <ReadingsDialog />}
      {dropping.value && (
        <div class="drop" aria-hidden="true">
          <p>{t`Drop a model to open it`}</p>
        </div>
      )}
    </div>
  );
}

interface Foldable {
  readonly open: { value: boolean };
  readonly children: ComponentChildren;
}

function SidePanel({ title, side, open, children }: Foldable & { title: string; side: 'left' | 'right' }) {
  const fold = side === 'left' ? 'left' : 'right';
  const unfold = side === 'left' ? 'right' : 'left';
  return (
    <aside class={`side panel ${side} ${open.value ? '' : 'folded'}`} aria-label={title}>
      <header>
        <h2>{title}</h2>
        <button
          type="button"
          class="button icon-only"
          aria-expanded={open.value}
          aria-label={open.value ? t`Fold ${title}` : t`Unfold ${title}`}
          onClick={() => {
            open.value = !open.value;
          }}
        >
          <Icon name={open.value ? fold : unfold} />
        </button>
      </header>
      {open.value && <div class="scroll">{children}</div>}
    </aside>
  );
}

function Sheet({ tab, open, children }: Foldable & { tab: { value: 'edits' | 'parts' } }) {
  return (
    <section class={`sheet panel ${open.value ? '' : 'folded'}`} aria-label={t`Edits and parts`}>
      <div class="tabs">
        {(['edits', 'parts'] as const).map((name) => (
          <button
            key={name}
            type="button"
            aria-pressed={open.value && tab.value === name}
            onClick={() => {
              open.value = !(open.value && tab.value === name);
              tab.value = name;
            }}
          >
            {name === 'edits' ? t`Edits` : t`Parts`}
          </button>
        ))}
      </div>
      {open.value && <div class="scroll">{children}</div>}
    </section>
  );
}

/** `?embed`: the model and its sliders, nothing else. */
function Embedded() {
  const pickKind = useSignal<FeatureKind | null>(null);
  const { layers } = document.value;
  const cards = useStandsBelow();
  const insets: Insets = { left: 0, right: 0, top: 0, bottom: layers.length > 0 ? coveredBelow.value + 8 : 0 };
  return (
    <div class="app embedded">
      <StageView insets={insets} pickKind={pickKind} />
      <main>
        <h1 class="visually-hidden">{document.value.model?.shape.name ?? 'ParSEL'}</h1>
        <div class="centre low">
          <StatusLine />
        </div>
        <ul class="cards embedded-cards" ref={cards}>
          {layers.map((entry) => (
            <LayerCard key={entry.key} entry={entry} first last plain />
          ))}
        </ul>
      </main>
    </div>
  );
}

/** Files that are dropped anywhere on the page. */
function listenForDrops(over: (isOver: boolean) => void): () => void {
  const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  const onOver = (event: DragEvent) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    over(true);
  };
  const onLeave = (event: DragEvent) => {
    if (event.relatedTarget === null) over(false);
  };
  const onDrop = (event: DragEvent) => {
    if (!hasFiles(event) || event.dataTransfer === null) return;
    event.preventDefault();
    over(false);
    dialog.value = null;
    void openAny(readDropped(event.dataTransfer));
  };
  addEventListener('dragover', onOver);
  addEventListener('dragleave', onLeave);
  addEventListener('drop', onDrop);
  return () => {
    removeEventListener('dragover', onOver);
    removeEventListener('dragleave', onLeave);
    removeEventListener('drop', onDrop);
  };
}
