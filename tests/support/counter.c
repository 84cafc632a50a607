/* An FMU of FMI 3.0, written by hand: der(x) = u + v + rate, and n counts events. v can be set at events alone. In model exchange it has no indicators: it
   sees that x has come to 1 when it is told of a completed step, and then sets x to 0; after the third time it ends.
   In co-simulation it has time events every 0.25 s, at which n counts and u is taken, and no step may lead across one;
   with the token "eventless" it has none, whatever its description says. */

#include "fmi3Functions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { U = 1, X, DER_X, N, RATE, V };
#define PERIOD 0.25

typedef struct {
    double time, x, u, v, taken, n, rate;
    int steps, events, eventless, due, continuous;
} counter;

static fmi3Instance make(int steps, int events) {
    counter *s = calloc(1, sizeof *s);
    s->steps = steps, s->events = events;
    return s;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                          fmi3Boolean logs, fmi3InstanceEnvironment of, fmi3LogMessageCallback log) {
    (void)name, (void)place, (void)visible, (void)logs, (void)of, (void)log, (void)token;
    return make(0, 0);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                         fmi3Boolean logs, fmi3Boolean events, fmi3Boolean early,
                                         const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment of,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    (void)name, (void)place, (void)visible, (void)logs, (void)early, (void)needed, (void)n, (void)of;
    (void)log, (void)update;
    const int eventless = !strcmp(token, "eventless");
    counter *s = eventless && events ? NULL : make(1, events);
    if (s) s->eventless = eventless;
    return s;
}

void fmi3FreeInstance(fmi3Instance s) { free(s); }

fmi3Status fmi3Reset(fmi3Instance instance) {
    counter *s = instance;
    const counter fresh = {.steps = s->steps, .events = s->events, .eventless = s->eventless};
    *s = fresh;
    return fmi3OK;
}

static double *place(counter *s, fmi3ValueReference of) {
    return of == U ? &s->u : of == V ? &s->v : of == X ? &s->x : of == N ? &s->n : of == RATE ? &s->rate : NULL;
}

fmi3Status fmi3SetFloat64(fmi3Instance s, const fmi3ValueReference of[], size_t count, const fmi3Float64 values[],
                          size_t n_values) {
    for (size_t i = 0; i < count; i++) {
        if (!place(s, of[i]) || (of[i] == V && ((counter *)s)->continuous)) return fmi3Error;
        *place(s, of[i]) = values[i];
    }
    return count == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance s, const fmi3ValueReference of[], size_t count, fmi3Float64 values[],
                          size_t n_values) {
    for (size_t i = 0; i < count; i++) {
        if (!place(s, of[i])) return fmi3Error;
        values[i] = *place(s, of[i]);
    }
    return count == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance s, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_end, fmi3Float64 end) {
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    ((counter *)s)->time = start;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }
fmi3Status fmi3EnterStepMode(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }
fmi3Status fmi3Terminate(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }

fmi3Status fmi3EnterEventMode(fmi3Instance s) {
    ((counter *)s)->continuous = 0;
    return fmi3OK;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance s) {
    ((counter *)s)->continuous = 1;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *ends, fmi3Boolean *nominals,
                                    fmi3Boolean *jumped, fmi3Boolean *is_next, fmi3Float64 *next) {
    counter *s = instance;
    *again = *ends = *nominals = *jumped = *is_next = fmi3False;
    s->taken = s->u;
    if (s->steps) {
        *is_next = fmi3True;
        s->n = round(s->time / PERIOD);
        *next = PERIOD * (s->n + 1);
    } else if (s->due) {
        s->due = 0, s->x = 0, s->n += 1;
        *jumped = fmi3True;
    }
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_return, fmi3Boolean *event,
                                       fmi3Boolean *ends) {
    counter *s = instance;
    (void)no_return;
    s->due = s->x >= 1 - 1e-9;
    *event = s->due;
    *ends = s->n >= 3;
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance s, fmi3Float64 time) {
    ((counter *)s)->time = time;
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance s, const fmi3Float64 x[], size_t n) {
    ((counter *)s)->x = x[0];
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance s, fmi3Float64 x[], size_t n) {
    x[0] = ((counter *)s)->x;
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 rates[], size_t n) {
    const counter *s = instance;
    rates[0] = s->u + s->v + s->rate;
    return n == 1 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance s, fmi3Float64 values[], size_t n) {
    return (void)s, (void)values, n ? fmi3Error : fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 size, fmi3Boolean no_return,
                      fmi3Boolean *event, fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *last) {
    counter *s = instance;
    (void)no_return;
    *ends = *early = fmi3False;
    s->x += size * ((s->eventless ? s->u : s->taken) + s->rate);
    s->time = *last = time + size;
    *event = fabs(s->time - PERIOD * (s->n + 1)) < 1e-9;
    if (s->eventless) return (*event = fmi3False), fmi3OK;
    return s->events && s->time <= PERIOD * (s->n + 1) + 1e-9 ? fmi3OK : fmi3Error;
}
