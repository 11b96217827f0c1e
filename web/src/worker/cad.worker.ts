// The module for CAD programs and their families.
import createModule from 'parsel-module/parsel_cad.mjs';
import { serve } from './serve';

serve(createModule);
