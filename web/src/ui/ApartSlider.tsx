// How far the parts stand apart in the exploded view, and the way back.
import { t } from '../texts/texts';
import { Icon } from './Icon';
import { apart, toggleApart } from './view';

export function ApartSlider() {
  if (apart.value === 0) return null;
  return (
    <div class="apart">
      <Icon name="apart" />
      <input
        type="range"
        min={0}
        max={1}
        step={0.01}
        value={apart.value}
        aria-label={t`How far the parts are drawn apart`}
        aria-valuetext={`${Math.round(apart.value * 100)} %`}
        onInput={(event) => {
          // At 0 the slider would vanish under the hand.
          apart.value = Math.max(0.01, event.currentTarget.valueAsNumber);
        }}
      />
      <button
        type="button"
        class="button icon-only"
        aria-label={t`Put the parts together`}
        title={t`Together (E)`}
        onClick={toggleApart}
      >
        <Icon name="close" />
      </button>
    </div>
  );
}
