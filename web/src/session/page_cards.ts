// What can be done with the page's own cards.
import { createCards } from './cards';
import { session } from './session';

export const { applyPreset, duplicateLayer, removePreset, resetAll, savePreset, setGroup, setUnit } =
  createCards(session);
