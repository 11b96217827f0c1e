// Model, history, sharing, export, help, theme.
import { isPlaced } from '../session/placing';
import { document, redo, redoLabel, selected, undo, undoLabel } from '../session/session';
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
import { Menu, type MenuItem } from './Menu';
import { startTour } from './Tour';
import { isDark, toggleTheme } from './theme';
import { apart, showColours, toggleApart } from './view';

function exportItems(): MenuItem[] {
  const { model, layers, family } = document.value;
  const none = model === null;
  const noLayer = none || !layers.some(({ enabled }) => enabled);
  return [
    { label: 'Edited model', hint: '.glb', disabled: none, act: () => void exportModel('all') },
    ...(model !== null && isPlaced(model.files)
      ? [
          {
            label: 'Edited model as it stands here',
            hint: '.glb',
            act: () => void exportModel('all', { asItStands: true }),
          },
        ]
      : []),
    {
      label: 'Edited, gaps closed',
      hint: '.glb',
      disabled: noLayer,
      act: () => void exportModel('all', { repair: true }),
    },
    {
      label: 'Edited, gaps filled',
      hint: '.glb',
      disabled: noLayer,
      act: () => void exportModel('all', { repair: 'fill' }),
    },
    {
      label: selected.value.length > 1 ? 'Selected parts only' : 'Selected part only',
      hint: '.glb',
      disabled: none || selected.value.length === 0,
      act: () => void exportModel('selected'),
    },
    { label: 'For printing…', hint: '.stl .3mf', disabled: none, act: () => (dialog.value = 'print') },
    { label: 'Animated by the last slider', hint: '.glb', disabled: noLayer, act: () => void exportModel('animated') },
    { label: 'Model with sliders', hint: 'one .glb', disabled: noLayer, act: () => void exportOneFile() },
    { label: 'Sliders alone', hint: '.sliders.json', disabled: noLayer, act: () => void exportSliders() },
    ...(family === undefined ? [] : [{ label: 'OpenSCAD with sliders', hint: '.scad', act: () => void exportScad() }]),
    { label: 'Program', hint: '.json', disabled: noLayer, act: exportProgram },
    { label: 'Session', hint: '.parsel.json', disabled: none, act: saveSession },
    { label: 'Picture', hint: '.png', disabled: none, act: () => void exportScreenshot() },
  ];
}

export function TopBar() {
  const { model } = document.value;
  return (
    <header class="bar panel">
      <h1>ParSEL</h1>
      <button type="button" class="button model" aria-haspopup="dialog" onClick={() => (dialog.value = 'open')}>
        <Icon name="open" />
        {model !== null && <span class="quiet wide-only">Open</span>}
        <span class="model-name">{model?.shape.name ?? 'Open a model'}</span>
      </button>
      <div class="bar-middle">
        <button
          type="button"
          class="button icon-only"
          aria-label={undoLabel.value === null ? 'Undo' : `Undo: ${undoLabel.value}`}
          title={`Undo ${undoLabel.value ?? ''} (Ctrl+Z)`}
          disabled={undoLabel.value === null}
          onClick={undo}
        >
          <Icon name="undo" />
        </button>
        <button
          type="button"
          class="button icon-only"
          aria-label={redoLabel.value === null ? 'Redo' : `Redo: ${redoLabel.value}`}
          title={`Redo ${redoLabel.value ?? ''} (Ctrl+Shift+Z)`}
          disabled={redoLabel.value === null}
          onClick={redo}
        >
          <Icon name="redo" />
        </button>
      </div>
      <button
        type="button"
        class="button"
        aria-label="Share"
        disabled={model === null}
        aria-haspopup="dialog"
        onClick={() => (dialog.value = 'share')}
      >
        <Icon name="share" />
        <span class="wide-only">Share</span>
      </button>
      <Menu label="Export" items={exportItems()}>
        <Icon name="export" />
        <span class="wide-only">Export</span>
      </Menu>
      <Menu
        label="View and help"
        class="button icon-only"
        items={[
          { label: 'Keyboard and help', hint: '?', act: () => (dialog.value = 'help') },
          { label: 'Tour', act: startTour },
          {
            label: showColours.value ? 'Own colours' : 'Colour the parts',
            act: () => (showColours.value = !showColours.value),
          },
          { label: apart.value > 0 ? 'Parts together' : 'Parts apart', hint: 'E', act: toggleApart },
          { label: isDark.value ? 'Light' : 'Dark', act: toggleTheme },
        ]}
      >
        <Icon name="help" />
      </Menu>
    </header>
  );
}
