// The limits of a kernel, for kernels and their host alike.
#ifndef RG_KERNELS_DIALECT_LIMITS_H
#define RG_KERNELS_DIALECT_LIMITS_H

#define RG_MAX_SLOTS       16   // 0 to 15, of which 0 is never used
#define RG_MAX_LEVELS      16   // of an image
#define RG_MAX_PARAMS_SIZE 1024 // bytes

#endif
