// CLN's configure writes this file; these are its answers for wasm32 without GMP.
#ifndef _CL_CONFIG_PUBLIC_H
#define _CL_CONFIG_PUBLIC_H
#include "cln/host_cpu.h"
#include "cln/version.h"
#define HAVE_LONGLONG 1
#endif
