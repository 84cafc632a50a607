/* An FMU of FMI 3.0, written by hand, with clocks of all kinds; whoever touches a clocked variable while none of its clocks
   is active, or a clock out of event mode, gets an error. der(z) = y.
   tick      at a tick y = K*u + x, and then x grows by u
   crossed   ticks as z comes to level; its variable is the instant
   later     a countdown: after `delay` from there z is set to 0
   burst     has longer and longer intervals, 0.1 s, 0.2 s and so on; b counts its ticks
   ask       is triggered from outside; a counts its ticks. */

#include "fmi3Functions.h"

#include <stdlib.h>

enum { U = 1, Y, K, Z, DER_Z, LEVEL, INSTANT, DELAY, B, A, INTERVAL, TICK = 20, CROSSED, LATER, BURST, ASK, END };
enum { START, INITIALIZATION, EVENT, CONTINUOUS, STEP };

typedef struct {
    double values[END], time, x;
    bool active[END];
    bool above, pending, scheduled, burst_known;
    int mode;
    bool steps;
} clocked;

static fmi3Instance make(bool steps) {
    clocked *s = calloc(1, sizeof *s);
    s->steps = steps;
    s->values[K] = 2, s->values[LEVEL] = 1e9, s->values[DELAY] = 0.15, s->values[INTERVAL] = 0.1;
    return s;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                          fmi3Boolean logs, fmi3InstanceEnvironment of, fmi3LogMessageCallback log) {
    (void)name, (void)place, (void)visible, (void)logs, (void)of, (void)log, (void)token;
    return make(false);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                         fmi3Boolean logs, fmi3Boolean events, fmi3Boolean early,
                                         const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment of,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    (void)name, (void)place, (void)visible, (void)logs, (void)needed, (void)n, (void)of, (void)token;
    (void)log, (void)update;
    return events && early ? make(true) : NULL;
}

void fmi3FreeInstance(fmi3Instance s) { free(s); }

fmi3Status fmi3Reset(fmi3Instance instance) {
    clocked *s = instance, *fresh = make(s->steps);
    *s = *fresh;
    free(fresh);
    return fmi3OK;
}

static bool is_accessible(const clocked *s, fmi3ValueReference of) {
    if (s->mode == START || s->mode == INITIALIZATION) return true;
    const int clock = of == U || of == Y ? TICK : of == INSTANT ? CROSSED : 0;
    return clock == 0 || (s->mode == EVENT && s->active[clock]);
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference of[], size_t count, const fmi3Float64 values[],
                          size_t n_values) {
    clocked *s = instance;
    for (size_t i = 0; i < count; i++) {
        if (!is_accessible(s, of[i])) return fmi3Error;
        s->values[of[i]] = values[i];
    }
    return count == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference of[], size_t count, fmi3Float64 values[],
                          size_t n_values) {
    clocked *s = instance;
    for (size_t i = 0; i < count; i++) {
        if (!is_accessible(s, of[i])) return fmi3Error;
        if (of[i] == Y && s->active[TICK]) s->values[Y] = s->values[K] * s->values[U] + s->x;
        values[i] = of[i] == DER_Z ? s->values[Y] : s->values[of[i]];
    }
    return count == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_end, fmi3Float64 end) {
    clocked *s = instance;
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    s->time = start, s->mode = INITIALIZATION;
    return fmi3OK;
}

static fmi3Status enter(clocked *s, int mode) {
    s->mode = mode;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance s) { return enter(s, EVENT); }
fmi3Status fmi3EnterStepMode(fmi3Instance s) { return enter(s, STEP); }
fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance s) { return enter(s, CONTINUOUS); }
fmi3Status fmi3Terminate(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    clocked *s = instance;
    const bool above = s->values[Z] - s->values[LEVEL] > -1e-12;
    if (above && !s->above) s->active[CROSSED] = true, s->values[INSTANT] = s->time;
    s->above = above;
    return enter(s, EVENT);
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference of[], size_t count, const fmi3Clock values[]) {
    clocked *s = instance;
    for (size_t i = 0; i < count; i++) {
        if (s->mode != EVENT || of[i] == CROSSED) return fmi3Error;
        s->active[of[i]] = values[i];
    }
    return fmi3OK;
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference of[], size_t count, fmi3Clock values[]) {
    clocked *s = instance;
    for (size_t i = 0; i < count; i++) {
        if (s->mode != EVENT || of[i] != CROSSED) return fmi3Error;
        values[i] = s->active[of[i]];
    }
    return fmi3OK;
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference of[], size_t count,
                                  const fmi3Float64 intervals[]) {
    clocked *s = instance;
    if (s->mode != INITIALIZATION || count != 1 || of[0] != TICK) return fmi3Error;
    s->values[INTERVAL] = intervals[0];
    return fmi3OK;
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference of[], size_t count, fmi3Float64 shifts[]) {
    clocked *s = instance;
    if (s->mode != INITIALIZATION || count != 1 || of[0] != TICK) return fmi3Error;
    shifts[0] = s->values[INTERVAL] / 2;
    return fmi3OK;
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference of[], size_t count,
                                  fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]) {
    clocked *s = instance;
    for (size_t i = 0; i < count; i++) {
        if (s->mode != EVENT && s->mode != INITIALIZATION) return fmi3Error;
        if (of[i] == TICK) {
            intervals[i] = s->values[INTERVAL], qualifiers[i] = fmi3IntervalChanged;
        } else if (of[i] == BURST) {
            intervals[i] = 0.1 * (s->values[B] + 1);
            qualifiers[i] = s->burst_known ? fmi3IntervalUnchanged : fmi3IntervalChanged;
            s->burst_known = true;
        } else if (of[i] == LATER) {
            intervals[i] = s->values[DELAY];
            qualifiers[i] = s->pending     ? fmi3IntervalChanged
                            : s->scheduled ? fmi3IntervalUnchanged
                                           : fmi3IntervalNotYetKnown;
            s->scheduled = s->scheduled || s->pending, s->pending = false;
        } else {
            return fmi3Error;
        }
    }
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *ends, fmi3Boolean *nominals,
                                    fmi3Boolean *jumped, fmi3Boolean *is_next, fmi3Float64 *next) {
    clocked *s = instance;
    (void)next;
    *again = *ends = *nominals = *jumped = *is_next = fmi3False;
    if (s->active[TICK]) s->values[Y] = s->values[K] * s->values[U] + s->x, s->x += s->values[U];
    if (s->active[CROSSED]) s->pending = true;
    if (s->active[LATER]) s->values[Z] = 0, s->above = s->scheduled = false, *jumped = !s->steps;
    if (s->active[BURST]) s->values[B] += 1, s->burst_known = false;
    if (s->active[ASK]) s->values[A] += 1;
    for (int i = TICK; i < END; i++) s->active[i] = false;
    return s->mode == EVENT ? fmi3OK : fmi3Error;
}

fmi3Status fmi3SetTime(fmi3Instance s, fmi3Float64 time) {
    ((clocked *)s)->time = time;
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance s, const fmi3Float64 x[], size_t n) {
    ((clocked *)s)->values[Z] = x[0];
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance s, fmi3Float64 x[], size_t n) {
    x[0] = ((clocked *)s)->values[Z];
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance s, fmi3Float64 rates[], size_t n) {
    rates[0] = ((clocked *)s)->values[Y];
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 values[], size_t n) {
    const clocked *s = instance;
    values[0] = s->values[Z] - s->values[LEVEL];
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 size, fmi3Boolean no_return,
                      fmi3Boolean *event, fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *last) {
    clocked *s = instance;
    (void)no_return;
    *ends = fmi3False;
    const double rise = s->values[Y], left = s->values[LEVEL] - s->values[Z];
    *event = *early = !s->above && rise > 0 && left <= rise * size;
    if (*event) size = left / rise;
    s->values[Z] += size * rise;
    s->time = *last = time + size;
    return s->mode == STEP ? fmi3OK : fmi3Error;
}
