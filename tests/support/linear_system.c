/* An FMU of FMI 3.0, written by hand: der(x) = A x + b u, y = x, with n states. It asks to end the simulation when its
   time event at 1 s comes. Structural is n; tests compile it against the headers of FMI. */

#include "fmi3Functions.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 4 };
enum { N = 1, A, B, START, U, X, DER_X, Y };

typedef struct {
    size_t n, steps;
    double time, a[MOST * MOST], b[MOST], start[MOST], u, x[MOST];
    fmi3Boolean configured, ends;
} system_of;

static void set_up(system_of *s) {
    memset(s, 0, sizeof *s);
    s->n = 1;
    s->a[0] = -1;
    s->b[0] = 1;
}

static fmi3Instance make(fmi3String token) {
    system_of *s = strcmp(token, "linear") ? NULL : malloc(sizeof *s);
    if (s) {
        set_up(s);
    }
    return s;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                          fmi3Boolean logs, fmi3InstanceEnvironment of, fmi3LogMessageCallback log) {
    (void)name, (void)place, (void)visible, (void)logs, (void)of, (void)log;
    return make(token);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String place, fmi3Boolean visible,
                                         fmi3Boolean logs, fmi3Boolean events, fmi3Boolean early,
                                         const fmi3ValueReference needed[], size_t n, fmi3InstanceEnvironment of,
                                         fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    (void)name, (void)place, (void)visible, (void)logs, (void)events, (void)early, (void)needed, (void)n, (void)of;
    (void)log, (void)update;
    return make(token);
}

void fmi3FreeInstance(fmi3Instance s) { free(s); }

fmi3Status fmi3Reset(fmi3Instance s) {
    set_up(s);
    return fmi3OK;
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance s) {
    ((system_of *)s)->configured = fmi3True;
    return fmi3OK;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance s) {
    ((system_of *)s)->configured = fmi3False;
    return fmi3OK;
}

fmi3Status fmi3SetUInt64(fmi3Instance instance, const fmi3ValueReference of[], size_t count, const fmi3UInt64 values[],
                         size_t n_values) {
    system_of *s = instance;
    if (!s->configured || count != 1 || n_values != 1 || of[0] != N || values[0] > MOST) {
        return fmi3Error;
    }
    s->n = values[0];
    return fmi3OK;
}

static double *place(system_of *s, fmi3ValueReference of, size_t *size) {
    *size = of == A ? s->n * s->n : of == U ? 1 : s->n;
    switch (of) {
    case A: return s->a;
    case B: return s->b;
    case START: return s->start;
    case U: return &s->u;
    case X:
    case Y: return s->x;
    default: return NULL;
    }
}

fmi3Status fmi3SetFloat64(fmi3Instance s, const fmi3ValueReference of[], size_t count, const fmi3Float64 values[],
                          size_t n_values) {
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        size_t size;
        double *into = place(s, of[i], &size);
        if (!into || at + size > n_values) {
            return fmi3Error;
        }
        memcpy(into, values + at, size * sizeof *into);
        at += size;
    }
    return at == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetFloat64(fmi3Instance s, const fmi3ValueReference of[], size_t count, fmi3Float64 values[],
                          size_t n_values) {
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        size_t size;
        const double *from = place(s, of[i], &size);
        if (!from || at + size > n_values) {
            return fmi3Error;
        }
        memcpy(values + at, from, size * sizeof *from);
        at += size;
    }
    return at == n_values ? fmi3OK : fmi3Error;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance s, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                       fmi3Float64 start, fmi3Boolean has_end, fmi3Float64 end) {
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    ((system_of *)s)->time = start;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    system_of *s = instance;
    memcpy(s->x, s->start, sizeof s->x);
    return fmi3OK;
}

fmi3Status fmi3EnterEventMode(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *ends, fmi3Boolean *nominals,
                                    fmi3Boolean *jumped, fmi3Boolean *is_next, fmi3Float64 *next) {
    system_of *s = instance;
    *again = *nominals = *jumped = fmi3False;
    *ends = s->time >= 1;
    *is_next = !*ends;
    *next = 1;
    return fmi3OK;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }

fmi3Status fmi3SetTime(fmi3Instance s, fmi3Float64 time) {
    ((system_of *)s)->time = time;
    return fmi3OK;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t n) {
    system_of *s = instance;
    memcpy(s->x, x, n * sizeof *x);
    return n == s->n ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t n) {
    system_of *s = instance;
    memcpy(x, s->x, n * sizeof *x);
    return n == s->n ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 rates[], size_t n) {
    system_of *s = instance;
    for (size_t i = 0; i < n; i++) {
        rates[i] = s->b[i] * s->u;
        for (size_t j = 0; j < n; j++) {
            rates[i] += s->a[i * n + j] * s->x[j];
        }
    }
    return n == s->n ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance s, fmi3Float64 values[], size_t n) {
    (void)s, (void)values;
    return n ? fmi3Error : fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 size, fmi3Boolean no_return,
                      fmi3Boolean *event, fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *last) {
    enum { PARTS = 100 };
    system_of *s = instance;
    double rates[MOST];
    (void)no_return;
    *event = *early = fmi3False;
    for (size_t k = 0; k < PARTS; k++) {
        fmi3GetContinuousStateDerivatives(s, rates, s->n);
        for (size_t i = 0; i < s->n; i++) {
            s->x[i] += size / PARTS * rates[i];
        }
    }
    s->time = *last = time + size;
    *ends = s->time >= 1 - 1e-12;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance s) { return s ? fmi3OK : fmi3Error; }
