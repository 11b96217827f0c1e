// Line icons of 20 units, in the colour of the text. Decorative: the control that holds one has a name of its own.
const paths = {
  undo: 'M8 5 4 9l4 4M4 9h8a4 4 0 0 1 0 8h-2',
  redo: 'm12 5 4 4-4 4m4-4H8a4 4 0 0 0 0 8h2',
  share: 'M10 12V3m0 0L7 6m3-3 3 3M5 10v6h10v-6',
  export: 'M10 3v9m0 0-3-3m3 3 3-3M4 14v3h12v-3',
  open: 'M3 16V5h5l2 2h7v9zM3 10h14',
  help: 'M7.500 7.500a2.500 2.500 0 1 1 3.500 2.300c-.700.300-1 .8-1 1.700M10 14.500v.1M10 2.500a7.500 7.500 0 1 0 0 15 7.500 7.500 0 0 0 0-15',
  theme: 'M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14',
  eye: 'M2 10s3-5 8-5 8 5 8 5-3 5-8 5-8-5-8-5m8-2a2 2 0 1 0 0 4 2 2 0 0 0 0-4',
  eyeOff: 'm3 3 14 14M8 5.300A8 8 0 0 1 10 5c5 0 8 5 8 5l-2 2.400M5 6.800 2 10s3 5 8 5c1 0 2-.2 2.800-.5',
  play: 'M6 4v12l10-6z',
  pause: 'M7 4v12M13 4v12',
  more: 'M5 10h.1M10 10h.1M15 10h.1',
  down: 'm5 8 5 5 5-5',
  right: 'm8 5 5 5-5 5',
  left: 'm12 5-5 5 5 5',
  move: 'M10 2.500v15M2.500 10h15M10 2.500 8 5m2-2.500L12 5M10 17.500 8 15m2 2.500 2-2.500M2.500 10 5 8m-2.500 2L5 12M17.500 10 15 8m2.500 2L15 12',
  apart: 'M4 4h4v4H4zM12 4h4v4h-4zM4 12h4v4H4zM12 12h4v4h-4z',
  text: 'M4 5h12M4 9h12M4 13h7',
  plus: 'M10 4v12M4 10h12',
  close: 'm5 5 10 10M15 5 5 15',
  check: 'm4 11 4 4 8-9',
  warning: 'M10 3 2 17h16zM10 8v4M10 14.500v.1',
  hand: 'M6 10V5a1.300 1.300 0 0 1 2.600 0v4V3.500a1.300 1.300 0 0 1 2.600 0V9 4.500a1.300 1.300 0 0 1 2.600 0V13c0 2.500-1.500 4.500-4.500 4.500-2 0-3-1-4-2.500l-2.500-3.500c-.8-1.200.8-2.200 1.700-1.300z',
  sparkle:
    'M9 3l1.500 4.500L15 9l-4.500 1.500L9 15l-1.500-4.500L3 9l4.500-1.500zM15.500 13l.7 1.800 1.800.7-1.800.7-.7 1.800-.7-1.800-1.800-.7 1.800-.7z',
  grid: 'M3.500 3.500h3v3h-3zM8.500 3.500h3v3h-3zM13.500 3.500h3v3h-3zM3.500 8.500h3v3h-3zM8.500 8.500h3v3h-3zM13.500 8.500h3v3h-3zM3.500 13.500h3v3h-3zM8.500 13.500h3v3h-3zM13.500 13.500h3v3h-3z',
  dice: 'M4 4h12v12H4zM7.500 7.500v.1M12.500 12.500v.1M10 10v.1',
  send: 'M10 16V4m0 0L5 9m5-5 5 5',
  settings: 'M3 6h8M15 6h2M3 14h2M9 14h8M13 4v4M7 12v4',
  several: 'M3 3h9v9H3zM8 15v2h9V8h-2m-10-.500 2 2 3.500-4',
  snap: 'M3 13h14M3 13V9M6.500 13v-2.500M10 13V9M13.500 13v-2.500M17 13V9',
  ruler: 'm3 13 10-10 4 4L7 17zM6 10l1.500 1.500M9 7l1.500 1.500M12 4l1.500 1.500',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4',
} as const;

export type IconName = keyof typeof paths;

export function Icon({ name }: { name: IconName }) {
  return (
    <svg class={`icon icon-${name}`} viewBox="0 0 20 20" aria-hidden="true" focusable="false">
      <path d={paths[name]} />
    </svg>
  );
}
