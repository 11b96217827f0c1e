// Dialogs that few visitors open: their code comes with their first opening, and their title says so until it is there.
import type { ComponentType } from 'preact';
import { m, type Sentence, t } from '../texts/texts';
import { dialog } from './actions';
import { Dialog } from './Dialog';
import { lazily } from './lazily';

const close = () => {
  dialog.value = null;
};

const late = (title: Sentence, load: () => Promise<ComponentType>) =>
  lazily(load, (line) => (
    <Dialog title={t(title)} onClose={close}>
      {line}
    </Dialog>
  ));

export const ExploreDialog = late(m`Siblings`, async () => (await import('./ExploreDialog')).ExploreDialog);
export const HelpDialog = late(m`Keyboard and help`, async () => (await import('./HelpDialog')).HelpDialog);
export const ModelDialog = late(m`Language model`, async () => (await import('./ModelDialog')).ModelDialog);
export const PrintDialog = late(m`For printing`, async () => (await import('./PrintDialog')).PrintDialog);
export const ProgramDialog = late(m`Program`, async () => (await import('./ProgramDialog')).ProgramDialog);
export const ReadingsDialog = late(m`Other readings`, async () => (await import('./ReadingsDialog')).ReadingsDialog);
export const ShareDialog = late(m`Share`, async () => (await import('./ShareDialog')).ShareDialog);
