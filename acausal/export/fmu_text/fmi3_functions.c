/* The functions of FMI 3.0: model exchange and co-simulation. */
#include "fmi3_interface.h"

typedef struct {
    fmi3LogMessageCallback logger;
    void *environment;
    fmi3IntermediateUpdateCallback update;
    bool event_mode, may_return_early, happened; /* happened: an event for which the last step has ended early */
} Host;

#define WITH_ADJOINT
#include "fmu_instance.h"

static void tell(Instance *c, int status, const char *message) {
    if (c->host.logger)
        c->host.logger(c->host.environment, (fmi3Status)status,
                       status == DISCARD ? "logStatusDiscard" : "logStatusError", message);
}

static int interrupted(Instance *c, int happened) {
    Host *host = &c->host;
    bool wanted = false;
    double until = c->reached;
    if (host->update)
        host->update(host->environment, c->reached, false, true, true, host->may_return_early, &wanted, &until);
    host->happened = happened && host->event_mode && host->may_return_early;
    return host->happened || (wanted && host->may_return_early && until <= c->reached);
}

typedef fmi3Status Status;
typedef fmi3Boolean Truth;
typedef fmi3Byte Byte;

#define OF_STATE(verb, rest) FMI(verb##FMUState##rest)
#define DESERIALIZE FMI(DeserializeFMUState)
#define GET_RATES FMI(GetContinuousStateDerivatives)
#include "fmu_functions.h"

/* -- common --------------------------------------------------------------------------------------- */

FMI_EXPORT const char *FMI(GetVersion)(void) { return "3.0"; }

FMI_EXPORT fmi3Instance FMI(InstantiateModelExchange)(fmi3String name, fmi3String token, fmi3String resources,
                                                      fmi3Boolean visible, fmi3Boolean logging,
                                                      fmi3InstanceEnvironment environment,
                                                      fmi3LogMessageCallback logger) {
    (void)name, (void)resources, (void)visible, (void)logging;
    const Host host = {.logger = logger, .environment = environment};
    return instantiate(&host, token, MODEL_EXCHANGE);
}

FMI_EXPORT fmi3Instance FMI(InstantiateCoSimulation)(fmi3String name, fmi3String token, fmi3String resources,
                                                     fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                                     fmi3Boolean early_return,
                                                     const fmi3ValueReference intermediate[], size_t n_intermediate,
                                                     fmi3InstanceEnvironment environment,
                                                     fmi3LogMessageCallback logger,
                                                     fmi3IntermediateUpdateCallback update) {
    (void)name, (void)resources, (void)visible, (void)logging, (void)intermediate, (void)n_intermediate;
    const Host host = {logger, environment, update, event_mode, early_return, false};
    return instantiate(&host, token, CO_SIMULATION);
}

FMI_EXPORT fmi3Instance FMI(InstantiateScheduledExecution)(fmi3String name, fmi3String token, fmi3String resources,
                                                           fmi3Boolean visible, fmi3Boolean logging,
                                                           fmi3InstanceEnvironment environment,
                                                           fmi3LogMessageCallback logger,
                                                           fmi3ClockUpdateCallback update,
                                                           fmi3LockPreemptionCallback lock,
                                                           fmi3UnlockPreemptionCallback unlock) {
    (void)name, (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
    const Host host = {.logger = logger, .environment = environment};
    return instantiate(&host, token, 0);
}

STATUS FMI(EnterInitializationMode)(fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 time,
                                    fmi3Boolean has_end, fmi3Float64 end) {
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    begin(c, time);
    return fmi3OK;
}

NOTHING(EnterStepMode)
NOTHING(EnterConfigurationMode)
NOTHING(ExitConfigurationMode)
NOTHING(EvaluateDiscreteStates)

/* -- values --------------------------------------------------------------------------------------- */

STATUS FMI(GetFloat64)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3Float64 values[],
                       size_t size) {
    return (fmi3Status)get_values(c, references, n, values, size);
}

STATUS FMI(SetFloat64)(fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3Float64 values[],
                       size_t size) {
    return (fmi3Status)set_values(c, references, n, values, size);
}

/* There are numbers of this one type only, and one truth value. */
#define OTHER(type)                                                                                              \
    STATUS FMI(Get##type)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3##type values[],    \
                          size_t size) {                                                                         \
        (void)references, (void)values, (void)size;                                                              \
        return n ? (fmi3Status)unknown(c) : fmi3OK;                                                              \
    }                                                                                                            \
    STATUS FMI(Set##type)(fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3##type values[], \
                          size_t size) {                                                                         \
        (void)references, (void)values, (void)size;                                                              \
        return n ? (fmi3Status)unknown(c) : fmi3OK;                                                              \
    }

OTHER(Float32)
OTHER(Int8)
OTHER(UInt8)
OTHER(Int16)
OTHER(UInt16)
OTHER(Int32)
OTHER(UInt32)
OTHER(Int64)
OTHER(UInt64)
OTHER(String)

STATUS FMI(GetBoolean)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3Boolean values[],
                       size_t size) {
    int outside = 0;
    const int status = size == n ? get_outside(c, references, n, &outside) : unknown(c);
    for (size_t i = 0; status == OK && i < n; i++) values[i] = outside != 0;
    return (fmi3Status)status;
}

STATUS FMI(SetBoolean)(fmi3Instance c, const fmi3ValueReference references[], size_t n, const fmi3Boolean values[],
                       size_t size) {
    (void)references, (void)values, (void)size;
    return n ? (fmi3Status)unknown(c) : fmi3OK;
}

STATUS FMI(GetBinary)(fmi3Instance c, const fmi3ValueReference references[], size_t n, size_t sizes[],
                      fmi3Binary values[], size_t size) {
    (void)references, (void)sizes, (void)values, (void)size;
    return n ? (fmi3Status)unknown(c) : fmi3OK;
}

STATUS FMI(SetBinary)(fmi3Instance c, const fmi3ValueReference references[], size_t n, const size_t sizes[],
                      const fmi3Binary values[], size_t size) {
    (void)references, (void)sizes, (void)values, (void)size;
    return n ? (fmi3Status)unknown(c) : fmi3OK;
}

/* There are no clocks. */
#define CLOCKS(name, ...)                                                                               \
    STATUS FMI(name)(fmi3Instance c, const fmi3ValueReference references[], size_t n, __VA_ARGS__) {      \
        (void)references, (void)first;                                                                  \
        return n ? (fmi3Status)unknown(c) : fmi3OK;                                                     \
    }
#define CLOCKS2(name, ...)                                                                              \
    STATUS FMI(name)(fmi3Instance c, const fmi3ValueReference references[], size_t n, __VA_ARGS__) {      \
        (void)references, (void)first, (void)second;                                                    \
        return n ? (fmi3Status)unknown(c) : fmi3OK;                                                     \
    }

CLOCKS(GetClock, fmi3Clock first[])
CLOCKS(SetClock, const fmi3Clock first[])
CLOCKS2(GetIntervalDecimal, fmi3Float64 first[], fmi3IntervalQualifier second[])
CLOCKS(SetIntervalDecimal, const fmi3Float64 first[])
CLOCKS(GetShiftDecimal, fmi3Float64 first[])
CLOCKS(SetShiftDecimal, const fmi3Float64 first[])
CLOCKS2(GetShiftFraction, fmi3UInt64 first[], fmi3UInt64 second[])
CLOCKS2(SetShiftFraction, const fmi3UInt64 first[], const fmi3UInt64 second[])
CLOCKS2(SetIntervalFraction, const fmi3UInt64 first[], const fmi3UInt64 second[])

STATUS FMI(GetIntervalFraction)(fmi3Instance c, const fmi3ValueReference references[], size_t n, fmi3UInt64 counters[],
                                fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]) {
    (void)references, (void)counters, (void)resolutions, (void)qualifiers;
    return n ? (fmi3Status)unknown(c) : fmi3OK;
}

STATUS FMI(ActivateModelPartition)(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time) {
    (void)clock, (void)time;
    return (fmi3Status)unknown(c);
}

/* No array changes its size, so dependencies are those of the model description. */
STATUS FMI(GetNumberOfVariableDependencies)(fmi3Instance c, fmi3ValueReference reference, size_t *n) {
    (void)reference, (void)n;
    return (fmi3Status)complain(c, FAILED, TITLE ": dependencies are in modelDescription.xml.");
}

STATUS FMI(GetVariableDependencies)(fmi3Instance c, fmi3ValueReference reference, size_t dependent[],
                                    fmi3ValueReference independents[], size_t elements[], fmi3DependencyKind kinds[],
                                    size_t n) {
    (void)reference, (void)dependent, (void)independents, (void)elements, (void)kinds, (void)n;
    return (fmi3Status)complain(c, FAILED, TITLE ": dependencies are in modelDescription.xml.");
}

/* -- derivatives ---------------------------------------------------------------------------------- */

STATUS FMI(GetDirectionalDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[], size_t n_unknowns,
                                     const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[],
                                     size_t n_seed, fmi3Float64 result[], size_t n_result) {
    return (fmi3Status)directional(c, unknowns, n_unknowns, knowns, n_knowns, seed, n_seed, result, n_result);
}

STATUS FMI(GetAdjointDerivative)(fmi3Instance c, const fmi3ValueReference unknowns[], size_t n_unknowns,
                                 const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[],
                                 size_t n_seed, fmi3Float64 result[], size_t n_result) {
    return (fmi3Status)adjoint(c, unknowns, n_unknowns, knowns, n_knowns, seed, n_seed, result, n_result);
}

/* -- model exchange ------------------------------------------------------------------------------- */

STATUS FMI(UpdateDiscreteStates)(fmi3Instance c, fmi3Boolean *again, fmi3Boolean *terminate, fmi3Boolean *nominals,
                                 fmi3Boolean *states, fmi3Boolean *has_next, fmi3Float64 *next) {
    int changed, timed;
    const int status = update(c, &changed, &timed, next);
    *again = *terminate = *nominals = false;
    *states = changed;
    *has_next = timed;
    return (fmi3Status)status;
}

STATUS FMI(GetNumberOfEventIndicators)(fmi3Instance c, size_t *n) {
    (void)c;
    *n = N_INDICATORS;
    return fmi3OK;
}

STATUS FMI(GetNumberOfContinuousStates)(fmi3Instance c, size_t *n) {
    (void)c;
    *n = N_STATES;
    return fmi3OK;
}

/* -- co-simulation -------------------------------------------------------------------------------- */

STATUS FMI(DoStep)(fmi3Instance instance, fmi3Float64 time, fmi3Float64 h, fmi3Boolean no_return, fmi3Boolean *event,
                   fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached) {
    Instance *c = instance;
    (void)no_return;
    *event = *terminate = *early = c->host.happened = false;
    const int status = advance(c, time, h);
    *reached = c->reached;
    *event = c->host.happened;
    *early = status == OK && c->reached < time + h * (1 - 1e-12);
    *terminate = status != OK;
    return (fmi3Status)status;
}

STATUS FMI(GetOutputDerivatives)(fmi3Instance c, const fmi3ValueReference references[], size_t n,
                                 const fmi3Int32 orders[], fmi3Float64 values[], size_t size) {
    (void)references, (void)orders, (void)values, (void)size;
    return n ? (fmi3Status)complain(c, FAILED, TITLE ": outputs have no derivatives here.") : fmi3OK;
}
