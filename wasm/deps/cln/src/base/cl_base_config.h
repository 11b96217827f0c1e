#ifndef _CL_BASE_CONFIG_H
#define _CL_BASE_CONFIG_H
#define HAVE_GETTIMEOFDAY 1
#define GETTIMEOFDAY_TZP_T void*
#endif
