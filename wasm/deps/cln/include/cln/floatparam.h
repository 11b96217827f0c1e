// CLN's configure probes these at run time; WebAssembly fixes IEEE 754 arithmetic with round-to-nearest.
#ifndef _CL_FLOATPARAM_H
#define _CL_FLOATPARAM_H

#define rounds_to_nearest 0
#define rounds_to_zero 1
#define rounds_to_infinity 2
#define rounds_to_minus_infinity 3

#define float_mant_bits 24
#define float_rounds rounds_to_nearest
#define double_mant_bits 53
#define double_rounds rounds_to_nearest
#define double_wordorder_bigendian_p 0

#endif
