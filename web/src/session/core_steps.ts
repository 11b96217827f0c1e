// What the core and workers beside it say they are doing and asking, by their own words: the few that are no names of parts.
import { m, type Sentence, t } from '../texts/texts';

const said: Readonly<Record<string, Sentence>> = {
  'reading the model': m`reading the model`,
  'looking for what hangs together': m`looking for what hangs together`,
  'looking for creases': m`looking for creases`,
  'writing the parts': m`writing the parts`,
  'looking for a way that keeps more': m`looking for a way that keeps more`,
  'finding the range and proving the relations': m`finding the range and proving the relations`,
  'the change': m`the change`,
  'what other parts do': m`what other parts do`,
  'mirror symmetries': m`mirror symmetries`,
  'rows and rings': m`rows and rings`,
  'fetching what rebuilds surfaces': m`fetching what rebuilds surfaces`,
  'looking at joints': m`looking at joints`,
  'fetching what unites and cuts': m`fetching what unites and cuts`,
  'looking at parts': m`looking at parts`,
  uniting: m`uniting`,
};

/** @param step as the core reports it (core/base/progress.h), a worker (web/src/worker), or as a task says what it asks about (core/infer/task.h); names of parts stay what they are */
export const stepWords = (step: string): string => {
  const known = Object.hasOwn(said, step) ? said[step] : undefined;
  return known === undefined ? step : t(known);
};
