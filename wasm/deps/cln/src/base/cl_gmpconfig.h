#ifndef _CL_GMPCONFIG_H
#define _CL_GMPCONFIG_H
#endif
