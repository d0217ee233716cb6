// Opening a device with what its name says of its driver.
#ifndef RG_HARNESS_DEVICES_DRIVERS_SIDE_H
#define RG_HARNESS_DEVICES_DRIVERS_SIDE_H

struct rg_device;
struct rg_asked;

// Whether all devices that are opened from here on are sides: each keeps compiled code in a folder
// of its own, as those do that have settings of their own. For gates.
void rg_sides_begin(void);

// Opens a device in a worker that has the variables that were asked for. The driver that runs is
// one that the name names. NULL, and one logged line, on failure.
struct rg_device *rg_side_open(const struct rg_asked *asked);

#endif
