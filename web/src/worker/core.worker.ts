// The module that the page begins with. GiNaC's first calls are several times slower than later ones: it is warmed up.
import createModule from 'parsel-module/parsel.mjs';
import { serve } from './serve';

serve(createModule, 'warm_up');
