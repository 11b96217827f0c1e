// The same commands: what is tested of the native command line holds of the package's.
import { tool } from './parsel';

process.env.PARSEL_TOOL = tool;
await import('../cli/parsel.test');
