// A timeline of frames on devices, in the trace event format that Perfetto and chrome://tracing
// open: a process for each device, in it a track of frames by the wall clock, one by the API's
// clock, and one of frames that wait after every pass, with the passes inside.
#ifndef RG_HARNESS_DEVICES_FRAMES_TRACE_H
#define RG_HARNESS_DEVICES_FRAMES_TRACE_H

#include <jansson.h>

#include "core/device/device.h"
#include "harness/devices/frames/subject.h"

struct rg_trace {
    json_t *events; // owned; NULL after memory ran out
    double begin_ms;
    int devices;
};

void rg_trace_begin(struct rg_trace *trace);
// Opens the subject on the device, and adds its process: the opening, then this many frames of each
// track. False, and one logged line, if the device fails; what it did until then stays.
bool rg_trace_device(struct rg_trace *trace, struct rg_device *device,
                     const struct rg_subject *subject, int frames);
// The text of the document, with the passport of the devices, and frees the trace. The caller frees
// it; NULL, and one logged line, when memory ran out.
char *rg_trace_end(struct rg_trace *trace, const struct rg_device_info *infos, int count);

#endif
