// CLN's configure writes this file; these are its answers for Emscripten without GMP.
#ifndef _CL_CONFIG_H
#define _CL_CONFIG_H
#include "cln/host_cpu.h"
#define _CL_CONFIG_PUBLIC_H
#define _CL_VERSION_H
#define CL_VERSION 1.3.6
#define CL_VERSION_MAJOR 1
#define CL_VERSION_MINOR 3
#define CL_VERSION_PATCHLEVEL 6
#define HAVE_ALLOCA_H 1
#define HAVE_CXX11 1
#define HAVE_GETTIMEOFDAY 1
#define HAVE_LONGLONG 1
#define HAVE_PERROR_DECL 1
#define HAVE_UNISTD_H 1
#define STDC_HEADERS 1
#endif
