// Model, history, sharing, export, help, theme.

import { isPlaced } from '../session/placing';
import { document, redo, redoLabel, selected, undo, undoLabel } from '../session/session';
import { t } from '../texts/texts';
import {
  dialog,
  exportModel,
  exportOneFile,
  exportProgram,
  exportScreenshot,
  exportSliders,
  saveSession,
} from './actions';
import { exportScad } from './family_export';
import { Icon } from './Icon';
import { changeLanguage, otherLanguages } from './language';
import { Menu, type MenuItem } from './Menu';
import { isDark, toggleTheme } from './theme';
import { startTour } from './tour_state';
import { apart, showColours, toggleApart } from './view';

function exportItems(): MenuItem[] {
  const { model, layers, family } = document.value;
  const none = model === null;
  const noLayer = none || !layers.some(({ enabled }) => enabled);
  return [
    { label: t`Edited model`, hint: '.glb', disabled: none, act: () => void exportModel('all') },
    ...(model !== null && isPlaced(model.files)
      ? [
          {
            label: t`Edited model as it stands here`,
            hint: '.glb',
            act: () => void exportModel('all', { asItStands: true }),
          },
        ]
      : []),
    {
      label: t`Edited, gaps closed`,
      hint: '.glb',
      disabled: noLayer,
      act: () => void exportModel('all', { repair: true }),
    },
    {
      label: t`Edited, gaps filled`,
      hint: '.glb',
      disabled: noLayer,
      act: () => void exportModel('all', { repair: 'fill' }),
    },
    {
      label: selected.value.length > 1 ? t`Selected parts only` : t`Selected part only`,
      hint: '.glb',
      disabled: none || selected.value.length === 0,
      act: () => void exportModel('selected'),
    },
    { label: t`Edited as OBJ`, hint: '.obj', disabled: none, act: () => void exportModel('all', { as: 'obj' }) },
    { label: t`Edited as STL`, hint: '.stl', disabled: none, act: () => void exportModel('all', { as: 'stl' }) },
    { label: t`For printing…`, hint: '.stl .3mf', disabled: none, act: () => (dialog.value = 'print') },
    { label: t`Animated by the last slider`, hint: '.glb', disabled: noLayer, act: () => void exportModel('animated') },
    { label: t`Model with sliders`, hint: t`one .glb`, disabled: noLayer, act: () => void exportOneFile() },
    { label: t`Sliders alone`, hint: '.sliders.json', disabled: noLayer, act: () => void exportSliders() },
    ...(family === undefined ? [] : [{ label: t`OpenSCAD with sliders`, hint: '.scad', act: () => void exportScad() }]),
    { label: t`Program`, hint: '.json', disabled: noLayer, act: exportProgram },
    { label: t`Session`, hint: '.parsel.json', disabled: none, act: saveSession },
    { label: t`Picture`, hint: '.png', disabled: none, act: () => void exportScreenshot() },
  ];
}

export function TopBar() {
  const { model } = document.value;
  return (
    <header class="bar panel">
      <h1>ParSEL</h1>
      <button type="button" class="button model" aria-haspopup="dialog" onClick={() => (dialog.value = 'open')}>
        <Icon name="open" />
        {model !== null && <span class="quiet wide-only">{t`Open`}</span>}
        <span class="model-name">{model?.shape.name ?? t`Open a model`}</span>
      </button>
      <div class="bar-middle">
        <button
          type="button"
          class="button icon-only"
          aria-label={undoLabel.value === null ? t`Undo` : t`Undo: ${undoLabel.value}`}
          title={undoLabel.value === null ? t`Undo (Ctrl+Z)` : t`Undo: ${undoLabel.value} (Ctrl+Z)`}
          disabled={undoLabel.value === null}
          onClick={undo}
        >
          <Icon name="undo" />
        </button>
        <button
          type="button"
          class="button icon-only"
          aria-label={redoLabel.value === null ? t`Redo` : t`Redo: ${redoLabel.value}`}
          title={redoLabel.value === null ? t`Redo (Ctrl+Shift+Z)` : t`Redo: ${redoLabel.value} (Ctrl+Shift+Z)`}
          disabled={redoLabel.value === null}
          onClick={redo}
        >
          <Icon name="redo" />
        </button>
      </div>
      <button
        type="button"
        class="button"
        aria-label={t`Share`}
        disabled={model === null}
        aria-haspopup="dialog"
        onClick={() => (dialog.value = 'share')}
      >
        <Icon name="share" />
        <span class="wide-only">{t`Share`}</span>
      </button>
      <Menu label={t`Export`} items={exportItems()}>
        <Icon name="export" />
        <span class="wide-only">{t`Export`}</span>
      </Menu>
      <Menu
        label={t`View and help`}
        class="button icon-only"
        items={[
          { label: t`Keyboard and help`, hint: '?', act: () => (dialog.value = 'help') },
          { label: t`Tour`, act: startTour },
          {
            label: showColours.value ? t`Own colours` : t`Colour the parts`,
            act: () => (showColours.value = !showColours.value),
          },
          { label: apart.value > 0 ? t`Parts together` : t`Parts apart`, hint: 'E', act: toggleApart },
          { label: isDark.value ? t`Light` : t`Dark`, act: toggleTheme },
          ...otherLanguages().map(([id, name]) => ({ label: name, lang: id, act: () => void changeLanguage(id) })),
        ]}
      >
        <Icon name="help" />
      </Menu>
    </header>
  );
}
