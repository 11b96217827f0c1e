// Whom the page asks for names of parts: as for suggestions, as often as the settings say.
import { votesFor } from '../llm/settings';
import { models } from './core';
import { createNaming } from './naming';
import { relabelAll } from './open';
import { session } from './session';
import { askerOf } from './suggestions';

export const names = createNaming({
  session,
  models,
  askerOf: (model) => askerOf(model, votesFor('names')),
  relabel: relabelAll,
});
