// CLN's configure writes this file; wasm32 is none of the processors that CLN has special code for. The header is part
// of every CLN and GiNaC header, so that its one fact about wasm32 reaches all code that holds CLN numbers.
#ifndef _CL_HOST_CPU_CONFIG_H
#define _CL_HOST_CPU_CONFIG_H
#define cl_word_alignment 4
#endif
