// CLN's configure probes these at run time, and gets them wrong under Emscripten (31-bit int, 63-bit long long:
// the probe relies on signed overflow). They are fixed by the wasm32 C ABI. Sizes are in bits as CLN counts them.
#ifndef _CL_INTPARAM_H
#define _CL_INTPARAM_H

#define char_bitsize 8
#define short_bitsize 16
#define int_bitsize 32
#define long_bitsize 32
#define long_long_bitsize 64
#define pointer_bitsize 32

#define sizeof_char 1
#define alignment_char 1
#define sizeof_short 2
#define alignment_short 2
#define sizeof_int 4
#define alignment_int 4
#define sizeof_long 4
#define alignment_long 4
#define sizeof_long_long 8
#define alignment_long_long 8
#define sizeof_float 4
#define alignment_float 4
#define sizeof_double 8
#define alignment_double 8

#define short_little_endian
#define int_little_endian
#define long_little_endian
#define long_long_little_endian
#define stack_grows_down

#endif
