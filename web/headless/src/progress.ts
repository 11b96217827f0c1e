// How far a batch is, on stderr: one line that is written over in a terminal, a line every ten seconds elsewhere.

const everyMs = 250;
const everyMsElsewhere = 10_000;

export class Progress {
  private done = 0;
  private refused = 0;
  private readonly start = performance.now();
  private readonly timer: NodeJS.Timeout;
  private note = '';

  /** @param total how many jobs are to be done; null when that is not known */
  constructor(private readonly total: number | null) {
    const terminal = process.stderr.isTTY;
    this.timer = setInterval(() => this.show(terminal), terminal ? everyMs : everyMsElsewhere);
    this.timer.unref();
  }

  add(isError: boolean): void {
    ++this.done;
    if (isError) ++this.refused;
  }

  /** What stands behind the figures from now on. */
  say(note: string): void {
    this.note = note;
  }

  /** A line of its own. */
  tell(text: string): void {
    process.stderr.write(`${process.stderr.isTTY ? '\r\u001b[K' : ''}${text}\n`);
  }

  get seconds(): number {
    return Math.round(performance.now() - this.start) / 1000;
  }

  get perSecond(): number {
    return this.done === 0 ? 0 : Number((this.done / Math.max(this.seconds, 1e-3)).toPrecision(3));
  }

  /** Takes the line away. */
  end(): void {
    clearInterval(this.timer);
    if (process.stderr.isTTY) process.stderr.write('\r\u001b[K');
  }

  private show(terminal: boolean): void {
    const rate = this.perSecond;
    const left = this.total !== null && rate > 0 ? `, ${inWords((this.total - this.done) / rate)} left` : '';
    const of = this.total === null ? '' : ` of ${this.total}`;
    const refused = this.refused === 0 ? '' : `, ${this.refused} refused`;
    const note = this.note === '' ? '' : ` (${this.note})`;
    const text = `${this.done}${of} done${refused}, ${rate} a second${left}${note}`;
    process.stderr.write(terminal ? `\r\u001b[K${text.slice(0, (process.stderr.columns ?? 80) - 1)}` : `${text}\n`);
  }
}

function inWords(seconds: number): string {
  if (seconds < 90) return `${Math.ceil(seconds)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
