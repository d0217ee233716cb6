// Opens a device with the driver that its name chooses.
#ifndef RG_HARNESS_DEVICES_DRIVERS_SIDE_H
#define RG_HARNESS_DEVICES_DRIVERS_SIDE_H

struct rg_device;
struct rg_asked;

// Makes every device opened from here on a side, with its own folder for compiled code, as devices
// with settings of their own have. For gates.
void rg_sides_begin(void);

// Opens a device in a worker with the variables of its name, and checks that the named driver runs.
// NULL, and one logged line, on failure.
struct rg_device *rg_side_open(const struct rg_asked *asked);

#endif
