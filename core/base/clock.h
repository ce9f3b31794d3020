/* SPDX-License-Identifier: MIT
 *
 * What time it is.
 */
#ifndef IRB_BASE_CLOCK_H
#define IRB_BASE_CLOCK_H

/* Monotonic time in seconds (CLOCK_MONOTONIC): durations survive changes of the wall clock. */
double irb_clock_s(void);

/* Wall-clock time as "2026-01-31T12:00:00Z" (UTC), for provenance only. */
void irb_clock_utc(char out[32]);

#endif
