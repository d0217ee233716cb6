// Drivers' caches of compiled code, where they do not know all that the code depends on.
#ifndef RG_HARNESS_DEVICES_SERVING_CACHES_H
#define RG_HARNESS_DEVICES_SERVING_CACHES_H

// Gives Mesa's cache a folder of its own where LP_NATIVE_VECTOR_WIDTH is set. Mesa keeps the
// machine code of llvmpipe by shader and processor, and not by this width: so a process runs what
// another one compiled for another width, and the two are equally fast. Nothing changes where
// MESA_SHADER_CACHE_DIR is set, or nothing says where the user's cache is. To be called before a
// driver is loaded.
void rg_caches_part(void);

#endif
