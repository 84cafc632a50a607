/* What FMI 2 and FMI 3 share: an instance of the model, its values by reference, derivatives, steps.

   The file that includes this one defines Host, what it knows of the importer, and tell(), which logs a message. */
#ifndef FMU_INSTANCE_H
#define FMU_INSTANCE_H

#include "fmu_model.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LEAST(n) ((n) > 0 ? (n) : 1)

/* A value reference is 2^24 times the kind, plus the number of the variable among its kind. */
enum { TIME, PARAMETERS, INPUTS, STATES, DERIVATIVES, OUTPUTS, INDICATORS, KINDS };

/* The numbers of these are those of fmi2Status and fmi3Status. */
enum { OK = 0, DISCARD = 2, FAILED = 3 };

/* All that changes: one copy is the FMU's state. */
typedef struct {
    Model m;
    int stale;        /* parameters have changed since the last calibration */
    int has_dx, has_y; /* m.dx, m.y belong to the present point */
    int starting, begun; /* not yet initialized; what holds at the start has been found */
    int outside, held; /* outside of the training range; held between two events of model exchange */
    double x_start[LEAST(N_STATES)]; /* states before that */
    char given[LEAST(N_STATES)];     /* states whose start values the importer has set */
} State;

typedef struct {
    State now;
    Host host;
    double reached; /* the end of the last successful step [s] */
    double before[LEAST(N_STATES)];
#if EVENTS
    double d_before[sizeof ((Model *)0)->d / sizeof(double)];
#endif
    double seed_time, seed_x[LEAST(N_STATES)], seed_u[LEAST(N_INPUTS)], seed_p[LEAST(N_PARAMETERS)];
    double of_dx[LEAST(N_STATES)], of_y[LEAST(N_OUTPUTS)];
    double indicators[LEAST(N_INDICATORS)];
} Instance;

static void tell(Instance *c, int status, const char *message);

/* Between two steps of co-simulation: whether the importer wants to go on later. happened: an event in the last one. */
static int interrupted(Instance *c, int happened);

static int complain(Instance *c, int status, const char *format, ...) {
    char message[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    tell(c, status, message);
    return status;
}

/* -- variables ------------------------------------------------------------------------------------ */

typedef struct {
    double *at; /* NULL: there is no such variable */
    int stride, count;
} Place;

static const Variable *const TABLES[KINDS] = {NULL, parameters_table, inputs_table, states_table, states_table,
                                              outputs_table, NULL};
static const unsigned GROUPS[KINDS] = {1, PARAMETER_GROUPS, INPUT_GROUPS, STATE_GROUPS, STATE_GROUPS, OUTPUT_GROUPS,
                                       N_INDICATORS > 0};

static Place find(double *const bases[KINDS], unsigned reference) {
    const unsigned kind = reference >> 24, number = reference & 0xffffff;
    Place place = {NULL, 1, 1};
    if (kind >= KINDS || !bases[kind]) return place;
    if (kind == TIME) {
        place.at = number ? NULL : bases[TIME];
    } else {
#if SCALARS
        static const unsigned sizes[KINDS] = {1, N_PARAMETERS, N_INPUTS, N_STATES, N_STATES, N_OUTPUTS,
                                                N_INDICATORS};
        place.at = number < sizes[kind] ? bases[kind] + number : NULL;
#else
        if (number < GROUPS[kind]) {
            const Variable *v = TABLES[kind] ? TABLES[kind] + number : NULL;
            place.at = bases[kind] + (v ? v->first : 0);
            place.stride = v ? v->stride : 1;
            place.count = v ? v->count : N_INDICATORS;
        }
#endif
    }
    return place;
}

/* How many numbers some variables have; -1 where one does not exist. */
static long length(double *const bases[KINDS], const unsigned references[], size_t n) {
    long sum = 0;
    for (size_t i = 0; i < n; i++) {
        const Place place = find(bases, references[i]);
        if (!place.at) return -1;
        sum += place.count;
    }
    return sum;
}

/* The name of a value. */
static void name_of(int place, unsigned kind, char name[], size_t room) {
    for (unsigned g = 0; g < GROUPS[kind]; g++) {
        const Variable *v = TABLES[kind] + g;
        const int from = place - v->first;
        if (from < 0 || from % v->stride || from / v->stride >= v->count) continue;
        const char *format = kind == DERIVATIVES ? "der(%s)" : "%s";
        const int n = snprintf(name, room, format, v->name);
        if (v->count > 1 && n > 0 && (size_t)n < room)
            snprintf(name + n, room - (size_t)n, " (number %d of %d)", from / v->stride + 1, v->count);
        return;
    }
    snprintf(name, room, "a value");
}

/* -- evaluation ----------------------------------------------------------------------------------- */

/* What is not finite here shows in the values that need it, which have names. */
static void calibrate(Instance *c) {
    if (c->now.stale) (void)model_recalibrate(&c->now.m);
    c->now.stale = 0;
}

static void moved(Instance *c) { c->now.has_dx = c->now.has_y = 0; }

#if EDGES
static void on_any_side(Model *m) { m->since = -INFINITY, m->until = INFINITY; }

/* What jumps at known times changes at events only: m->time moves to between the last one and the next. Returns it. */
static double between_events(Model *m) {
    const double apart = 32 * DBL_EPSILON, time = m->time;
    const double from = m->since + apart * fabs(m->since), to = m->until - apart * fabs(m->until);
    if (isfinite(m->since) && time < from) m->time = from;
    if (isfinite(m->until) && time > to) m->time = to;
    return time;
}
#else
static void on_any_side(Model *m) { (void)m; }
static double between_events(Model *m) { return m->time; }
#endif

static const char *const REASONS[] = {"",
                                      "a state is no finite number",
                                      "an implicit step has no unique solution",
                                      "Newton's method found no solution of an implicit step",
                                      "at an event discrete variables change each other without end",
                                      "events follow each other without end",
                                      "a state has run away"};

#if EVENTS
static int after_event(Instance *c, int status) {
    moved(c);
    if (!status) return OK;
    return complain(c, DISCARD, TITLE ": %s at t = %.9g s.", REASONS[status], c->now.m.time);
}

static int begin_events(Instance *c) { return after_event(c, (int)model_begin(&c->now.m)); }

/* An event; whether states have changed, and when the next one is due. */
static int update(Instance *c, int *changed, int *has_next, double *next) {
    Model *m = &c->now.m;
    calibrate(c);
    memcpy(c->before, m->x, sizeof c->before);
    const int status = after_event(c, (int)model_event(m));
    *changed = memcmp(c->before, m->x, sizeof c->before) != 0;
    *next = model_next_event(m);
    *has_next = isfinite(*next) != 0;
    return status;
}

static int find_indicators(Instance *c) {
    calibrate(c);
    Model *m = &c->now.m;
    const double time = between_events(m);
    const int is_behind = m->time > time, failed = model_conditions(m) != 0;
    m->time = time;
    if (failed) return complain(c, DISCARD, TITLE ": a condition is no finite number at t = %.9g s.", time);
    for (int i = 0; i < N_INDICATORS; i++) {
        const int k = abs(indicators[i]) - 1, is_strict = indicators[i] > 0;
        const int was_above = (m->d[k] > 0.5) == is_strict;
        const double z = is_strict ? m->e.number[k] : -m->e.number[k];
        c->indicators[i] = z != 0 ? z : -1; /* zero counts as negative; solvers look away from what is zero */
        if (is_behind && was_above != (z > 0)) c->indicators[i] *= -1; /* the event has not seen it change its sign */
    }
    return OK;
}

static void completed(Instance *c) {
    calibrate(c);
    const double time = between_events(&c->now.m);
    model_completed(&c->now.m);
    c->now.m.time = time;
}
#else
static int begin_events(Instance *c) { return (void)c, OK; }
static int update(Instance *c, int *changed, int *has_next, double *next) {
    *changed = *has_next = 0;
    *next = 0;
    calibrate(c);
#if EDGES
    moved(c);
    *next = model_next_event(&c->now.m);
    *has_next = isfinite(*next) != 0;
#endif
    return OK;
}
static int find_indicators(Instance *c) { return (void)c, OK; }
static void completed(Instance *c) { (void)c; }
#endif

/* Start values that follow from parameters and inputs, and what holds there; those that the importer has set stay. */
static int find_start(Instance *c) {
    State *now = &c->now;
    if (!now->starting || now->begun) return OK;
    calibrate(c);
    memcpy(now->x_start, now->m.x, sizeof now->x_start);
    const int status = (int)model_start(&now->m);
    for (int i = 0; i < N_STATES; i++)
        if (status || now->given[i]) now->m.x[i] = now->x_start[i];
    now->begun = 1;
    moved(c);
    if (!status) return begin_events(c);
    const char *why = status == 1 ? "no start values satisfy the initial conditions" : REASONS[status];
    return complain(c, DISCARD, TITLE ": %s with these parameters.", why);
}

/* Something changes before the start, so it is to be found again. */
static void change_start(Instance *c) {
    State *now = &c->now;
    if (now->starting && now->begun) memcpy(now->m.x, now->x_start, sizeof now->x_start);
    now->begun = 0;
}

static void give_start(Instance *c, Place place) {
    for (int k = 0; k < place.count && c->now.starting; k++)
        c->now.given[place.at - c->now.m.x + k * place.stride] = 1;
}

static int end_start(Instance *c) {
    const int status = find_start(c);
    c->now.starting = 0;
    return status;
}

static int get_indicators(Instance *c, double values[], size_t size) {
    if (size != N_INDICATORS) return complain(c, FAILED, TITLE ": the number of event indicators does not fit the model.");
    const int status = find_indicators(c);
    if (N_INDICATORS) memcpy(values, c->indicators, size * sizeof *values);
    return status;
}

static void forget_seeds(Instance *c) {
    c->seed_time = 0;
    memset(c->seed_x, 0, sizeof c->seed_x);
    memset(c->seed_u, 0, sizeof c->seed_u);
    memset(c->seed_p, 0, sizeof c->seed_p);
}

static int along_seeds(Instance *c) {
    Model *m = &c->now.m;
    const double time = between_events(m);
    const int failed = model_directional(m, c->seed_time, c->seed_x, c->seed_u, c->seed_p, c->of_dx, c->of_y) != 0;
    m->time = time;
    if (!failed) return OK;
    return complain(c, DISCARD, TITLE ": a directional derivative is no finite number at t = %.9g s.", time);
}

/* Derivatives or outputs at the present point. */
static int evaluate(Instance *c, unsigned kind) {
    State *now = &c->now;
    int *has = kind == DERIVATIVES ? &now->has_dx : &now->has_y;
    int status;
    if (kind == INDICATORS) return find_indicators(c);
    if (kind >= STATES && (status = find_start(c)) != OK) return status;
    if (kind != DERIVATIVES && kind != OUTPUTS) return OK;
    if (*has) return OK;
    calibrate(c);
    const double time = between_events(&now->m), past = time - now->m.time;
    const int failed = (kind == DERIVATIVES ? model_derivatives(&now->m) : model_outputs(&now->m)) != 0;
    now->m.time = time;
    if (failed) {
        char name[200];
        const double *values = kind == DERIVATIVES ? now->m.dx : now->m.y;
        int place = 0;
        while (isfinite(values[place])) place++;
        name_of(place, kind, name, sizeof name);
        return complain(c, DISCARD, TITLE ": '%s' is no finite number at t = %.9g s.", name, time);
    }
    if (past != 0) { /* it goes on as a line: instances whose events come a little later are compared */
        forget_seeds(c);
        c->seed_time = past;
        if ((status = along_seeds(c)) != OK) return status;
        for (int i = 0; kind == DERIVATIVES && i < N_STATES; i++) now->m.dx[i] += c->of_dx[i];
        for (int i = 0; kind == OUTPUTS && i < N_OUTPUTS; i++) now->m.y[i] += c->of_y[i];
    }
    *has = 1;
    return OK;
}

static int unknown(Instance *c) {
    return complain(c, FAILED, TITLE ": a value reference or the number of values does not fit the model.");
}

static int get_values(Instance *c, const unsigned references[], size_t n, double values[], size_t size) {
    Model *m = &c->now.m;
    double *const bases[KINDS] = {&m->time, m->p, m->u, m->x, m->dx, m->y, c->indicators};
    if (length(bases, references, n) != (long)size) return unknown(c);
    for (size_t i = 0; i < n; i++) {
        const Place place = find(bases, references[i]);
        const int status = evaluate(c, references[i] >> 24);
        if (status) return status;
        for (int k = 0; k < place.count; k++) *values++ = place.at[k * place.stride];
    }
    return OK;
}

static int set_values(Instance *c, const unsigned references[], size_t n, const double values[], size_t size) {
    Model *m = &c->now.m;
    double *const bases[KINDS] = {NULL, m->p, m->u, m->x, NULL, NULL};
    if (length(bases, references, n) != (long)size) return unknown(c);
    change_start(c);
    for (size_t i = 0; i < n; i++) {
        const Place place = find(bases, references[i]);
        for (int k = 0; k < place.count; k++) place.at[k * place.stride] = *values++;
        if (references[i] >> 24 == PARAMETERS) c->now.stale = 1;
        if (references[i] >> 24 == STATES) give_start(c, place);
    }
    moved(c);
    return OK;
}

/* Whether an argument of a network lies outside of the range in which it was trained. */
static int outside_now(Instance *c) {
#if WATCHES
    calibrate(c);
    return model_outside(&c->now.m);
#else
    return c->now.outside;
#endif
}

/* It changes at events only, so the end of a step where it would change asks for one. */
static int outside_changes(Instance *c) { return outside_now(c) != c->now.outside; }

static int hold_outside(Instance *c, int held) {
    c->now.outside = outside_now(c);
    c->now.held = held;
    return OK;
}

static int get_outside(Instance *c, const unsigned references[], size_t n, int *value) {
    for (size_t i = 0; i < n; i++)
        if (!WATCHES || references[i] != OUTSIDE_REFERENCE) return unknown(c);
    const int status = find_start(c);
    if (status) return status;
    *value = c->now.held ? c->now.outside : outside_now(c);
    return OK;
}

/* All states, or their derivatives, in the order of the model's structure. */
static size_t number_of_states(void) { return SCALARS ? N_STATES : STATE_GROUPS; }

static int each_state(Instance *c, unsigned kind, double get[], const double set[], size_t size) {
    if (size != N_STATES) return unknown(c);
    for (size_t i = 0; i < number_of_states(); i++) {
        const unsigned reference = (kind << 24) + (unsigned)i;
        double *const bases[KINDS] = {NULL, NULL, NULL, c->now.m.x, NULL, NULL};
        const size_t count = (size_t)find(bases, ((unsigned)STATES << 24) + (unsigned)i).count;
        const int status = get ? get_values(c, &reference, 1, get, count) : set_values(c, &reference, 1, set, count);
        if (status) return status;
        if (get) get += count;
        if (set) set += count;
    }
    return OK;
}

/* Their typical magnitudes, in the same order. */
static int nominals(Instance *c, double values[], size_t size) {
    double *const bases[KINDS] = {NULL, NULL, NULL, c->now.m.x, NULL, NULL};
    if (size != N_STATES) return unknown(c);
    for (size_t i = 0; i < number_of_states(); i++) {
        const Place place = find(bases, ((unsigned)STATES << 24) + (unsigned)i);
        for (int k = 0; k < place.count; k++) *values++ = nominal_of(place.at - c->now.m.x + k * place.stride);
    }
    return OK;
}

/* -- derivatives of derivatives ------------------------------------------------------------------- */

static int directional(Instance *c, const unsigned unknowns[], size_t n_unknowns, const unsigned knowns[],
                       size_t n_knowns, const double seed[], size_t n_seed, double result[], size_t n_result) {
    double *const seeds[KINDS] = {&c->seed_time, c->seed_p, c->seed_u, c->seed_x, NULL, NULL};
    double *const results[KINDS] = {NULL, NULL, NULL, c->seed_x, c->of_dx, c->of_y};
    if (length(seeds, knowns, n_knowns) != (long)n_seed || length(results, unknowns, n_unknowns) != (long)n_result)
        return unknown(c);
    int status;
    calibrate(c);
    forget_seeds(c);
    for (size_t i = 0; i < n_knowns; i++) {
        const Place place = find(seeds, knowns[i]);
        for (int k = 0; k < place.count; k++) place.at[k * place.stride] = *seed++;
    }
    if ((status = along_seeds(c)) != OK) return status;
    for (size_t i = 0; i < n_unknowns; i++) {
        const Place place = find(results, unknowns[i]);
        for (int k = 0; k < place.count; k++) *result++ = place.at[k * place.stride];
    }
    return OK;
}

#ifdef WITH_ADJOINT
/* One directional derivative for each known number. */
static int adjoint(Instance *c, const unsigned unknowns[], size_t n_unknowns, const unsigned knowns[], size_t n_knowns,
                   const double seed[], size_t n_seed, double result[], size_t n_result) {
    double *const seeds[KINDS] = {&c->seed_time, c->seed_p, c->seed_u, c->seed_x, NULL, NULL};
    double *const results[KINDS] = {NULL, NULL, NULL, c->seed_x, c->of_dx, c->of_y};
    if (length(seeds, knowns, n_knowns) != (long)n_result || length(results, unknowns, n_unknowns) != (long)n_seed)
        return unknown(c);
    int status;
    calibrate(c);
    forget_seeds(c);
    for (size_t i = 0; i < n_knowns; i++) {
        const Place known = find(seeds, knowns[i]);
        for (int k = 0; k < known.count; k++) {
            const double *next = seed;
            double sum = 0;
            known.at[k * known.stride] = 1;
            if ((status = along_seeds(c)) != OK) return status;
            for (size_t j = 0; j < n_unknowns; j++) {
                const Place place = find(results, unknowns[j]);
                for (int l = 0; l < place.count; l++) sum += *next++ * place.at[l * place.stride];
            }
            known.at[k * known.stride] = 0;
            *result++ = sum;
        }
    }
    return OK;
}
#endif

/* -- steps ---------------------------------------------------------------------------------------- */

/* From one time on by h, in equal steps of at most STEP, with the inputs held. */
static int advance(Instance *c, double from, double h) {
    Model *m = &c->now.m;
    const double parts = ceil(h / STEP * (1 - 1e-9));
    const long n = parts < 1 ? 1 : (long)parts;
    m->time = c->reached = from;
    calibrate(c);
    moved(c);
#if EVENTS
    const int at_once = after_event(c, (int)model_event(m)); /* inputs may have changed */
    if (at_once) return at_once;
#endif
    for (long i = 0; i < n; i++) {
        memcpy(c->before, m->x, sizeof c->before);
#if EVENTS
        memcpy(c->d_before, m->d, sizeof c->d_before);
#endif
        const int status = (int)model_step(m, h / (double)n, NULL);
        on_any_side(m);
        if (status) {
            char name[200] = "";
            if (status == 1 || status == 6) name_of(m->broken, STATES, name, sizeof name);
            memcpy(m->x, c->before, sizeof c->before);
            m->time = c->reached;
            return complain(c, status == 6 ? FAILED : DISCARD, TITLE ": %s after t = %.9g s%s%s; a smaller step may help.",
                            REASONS[status], c->reached, *name ? ": " : "", name);
        }
        m->time = c->reached = i == n - 1 ? from + h : from + h * (double)(i + 1) / (double)n;
#if EVENTS
        const int happened = memcmp(c->d_before, m->d, sizeof c->d_before) != 0;
#else
        const int happened = 0;
#endif
        if (interrupted(c, happened)) break;
    }
    return OK;
}

/* -- life ----------------------------------------------------------------------------------------- */

static void start(Instance *c) {
    memset(&c->now, 0, sizeof c->now);
    model_init(&c->now.m);
    memcpy(c->now.x_start, c->now.m.x, sizeof c->now.x_start);
    c->now.starting = 1;
    c->now.begun = !EVENTS; /* start values are those of the parameters */
    c->reached = 0;
}

static void begin(Instance *c, double time) {
    if (time != c->now.m.time) change_start(c);
    c->now.m.time = c->reached = time;
    moved(c);
}

static int keep(const Instance *c, void **kept) {
    if (!*kept) *kept = malloc(sizeof(State));
    if (!*kept) return FAILED;
    memcpy(*kept, &c->now, sizeof(State));
    return OK;
}

static int restore(Instance *c, const void *kept) {
    memcpy(&c->now, kept, sizeof(State));
    c->reached = c->now.m.time;
    return OK;
}

static int forget(void **kept) {
    free(*kept);
    *kept = NULL;
    return OK;
}

static int serialize(Instance *c, const void *kept, void *bytes, size_t size) {
    if (size < sizeof(State)) return complain(c, FAILED, TITLE ": there is no room for the serialized state.");
    memcpy(bytes, kept, sizeof(State));
    return OK;
}

static int deserialize(Instance *c, const void *bytes, size_t size, void **kept) {
    if (size != sizeof(State)) return complain(c, FAILED, TITLE ": these bytes are no state of this model.");
    if (!*kept) *kept = malloc(sizeof(State));
    if (!*kept) return FAILED;
    memcpy(*kept, bytes, size);
    return OK;
}

#endif
