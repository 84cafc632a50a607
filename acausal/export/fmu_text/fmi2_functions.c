/* The functions of FMI 2.0: model exchange and co-simulation. */
#include "fmi2_interface.h"

typedef struct {
    void (*logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    void *environment;
    char name[128];
} Host;

#include "fmu_instance.h"

/* The importer takes the message as a format, so each % is doubled. */
static void tell(Instance *c, int status, const char *message) {
    char format[800];
    size_t n = 0;
    for (; *message && n < sizeof format - 2; message++) {
        if (*message == '%') format[n++] = '%';
        format[n++] = *message;
    }
    format[n] = '\0';
    if (c->host.logger)
        c->host.logger(c->host.environment, c->host.name, (fmi2Status)status,
                       status == DISCARD ? "logStatusDiscard" : "logStatusError", format);
}

static int interrupted(Instance *c, int happened) { return (void)c, (void)happened, 0; }

#define STATUS FMI_EXPORT fmi2Status

/* -- common --------------------------------------------------------------------------------------- */

FMI_EXPORT const char *FMI(GetTypesPlatform)(void) { return "default"; }

FMI_EXPORT const char *FMI(GetVersion)(void) { return "2.0"; }

STATUS FMI(SetDebugLogging)(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
    (void)c, (void)on, (void)n, (void)categories; /* only failures are logged, and always */
    return fmi2OK;
}

FMI_EXPORT fmi2Component FMI(Instantiate)(fmi2String name, fmi2Type type, fmi2String token, fmi2String resources,
                                          const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                          fmi2Boolean logging) {
    (void)resources, (void)visible, (void)logging;
    Instance *c = calloc(1, sizeof(Instance));
    if (!c) return NULL;
    if (functions) {
        c->host.logger = functions->logger;
        c->host.environment = functions->componentEnvironment;
    }
    snprintf(c->host.name, sizeof c->host.name, "%s", name ? name : "");
    if (!token || strcmp(token, TOKEN) != 0)
        complain(c, FAILED, TITLE ": the token is not that of this binary; unpack the FMU again.");
    else if (type == fmi2ModelExchange ? !MODEL_EXCHANGE : !CO_SIMULATION)
        complain(c, FAILED, TITLE ": this FMU was not exported for this kind of use.");
    else {
        start(c);
        return c;
    }
    free(c);
    return NULL;
}

FMI_EXPORT void FMI(FreeInstance)(fmi2Component c) { free(c); }

STATUS FMI(SetupExperiment)(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real time,
                            fmi2Boolean has_end, fmi2Real end) {
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    begin(c, time);
    return fmi2OK;
}

#define NOTHING(name)              \
    STATUS FMI(name)(fmi2Component c) { \
        (void)c;                   \
        return fmi2OK;             \
    }

NOTHING(EnterInitializationMode)
NOTHING(Terminate)

STATUS FMI(ExitInitializationMode)(fmi2Component c) { return (fmi2Status)end_start(c); }

STATUS FMI(Reset)(fmi2Component c) {
    start(c);
    return fmi2OK;
}

/* -- values --------------------------------------------------------------------------------------- */

STATUS FMI(GetReal)(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2Real values[]) {
    return (fmi2Status)get_values(c, references, n, values, n);
}

STATUS FMI(SetReal)(fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2Real values[]) {
    return (fmi2Status)set_values(c, references, n, values, n);
}

/* There are numbers, and one truth value. */
#define OTHER(type)                                                                                                  \
    STATUS FMI(Get##type)(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2##type values[]) {     \
        (void)references, (void)values;                                                                              \
        return n ? (fmi2Status)unknown(c) : fmi2OK;                                                                  \
    }                                                                                                                \
    STATUS FMI(Set##type)(fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2##type values[]) { \
        (void)references, (void)values;                                                                              \
        return n ? (fmi2Status)unknown(c) : fmi2OK;                                                                  \
    }

OTHER(Integer)
OTHER(String)

STATUS FMI(GetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t n, fmi2Boolean values[]) {
    int outside = 0;
    const int status = get_outside(c, references, n, &outside);
    for (size_t i = 0; status == OK && i < n; i++) values[i] = outside;
    return (fmi2Status)status;
}

STATUS FMI(SetBoolean)(fmi2Component c, const fmi2ValueReference references[], size_t n, const fmi2Boolean values[]) {
    (void)references, (void)values;
    return n ? (fmi2Status)unknown(c) : fmi2OK;
}

/* -- the state of the FMU --------------------------------------------------------------------------- */

STATUS FMI(GetFMUstate)(fmi2Component c, fmi2FMUstate *state) { return (fmi2Status)keep(c, state); }

STATUS FMI(SetFMUstate)(fmi2Component c, fmi2FMUstate state) { return (fmi2Status)restore(c, state); }

STATUS FMI(FreeFMUstate)(fmi2Component c, fmi2FMUstate *state) {
    (void)c;
    return (fmi2Status)forget(state);
}

STATUS FMI(SerializedFMUstateSize)(fmi2Component c, fmi2FMUstate state, size_t *size) {
    (void)c, (void)state;
    *size = sizeof(State);
    return fmi2OK;
}

STATUS FMI(SerializeFMUstate)(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
    return (fmi2Status)serialize(c, state, bytes, size);
}

STATUS FMI(DeSerializeFMUstate)(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state) {
    return (fmi2Status)deserialize(c, bytes, size, state);
}

STATUS FMI(GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                     const fmi2ValueReference knowns[], size_t n_knowns, const fmi2Real seed[],
                                     fmi2Real result[]) {
    return (fmi2Status)directional(c, unknowns, n_unknowns, knowns, n_knowns, seed, n_knowns, result, n_unknowns);
}

/* -- model exchange ------------------------------------------------------------------------------- */

STATUS FMI(EnterEventMode)(fmi2Component c) { return (fmi2Status)hold_outside(c, 0); }

STATUS FMI(EnterContinuousTimeMode)(fmi2Component c) { return (fmi2Status)hold_outside(c, 1); }

STATUS FMI(NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info) {
    int changed, timed;
    memset(info, 0, sizeof *info);
    const int status = update(c, &changed, &timed, &info->nextEventTime);
    info->valuesOfContinuousStatesChanged = changed;
    info->nextEventTimeDefined = timed;
    return (fmi2Status)status;
}

STATUS FMI(CompletedIntegratorStep)(fmi2Component c, fmi2Boolean no_return, fmi2Boolean *event, fmi2Boolean *end) {
    (void)no_return;
    completed(c);
    *event = outside_changes(c);
    *end = 0;
    return fmi2OK;
}

STATUS FMI(SetTime)(fmi2Component c, fmi2Real time) {
    begin(c, time);
    return fmi2OK;
}

STATUS FMI(SetContinuousStates)(fmi2Component c, const fmi2Real x[], size_t n) {
    return (fmi2Status)each_state(c, STATES, NULL, x, n);
}

STATUS FMI(GetContinuousStates)(fmi2Component c, fmi2Real x[], size_t n) {
    return (fmi2Status)each_state(c, STATES, x, NULL, n);
}

STATUS FMI(GetDerivatives)(fmi2Component c, fmi2Real dx[], size_t n) {
    return (fmi2Status)each_state(c, DERIVATIVES, dx, NULL, n);
}

STATUS FMI(GetEventIndicators)(fmi2Component c, fmi2Real indicators[], size_t n) {
    return (fmi2Status)get_indicators(c, indicators, n);
}

STATUS FMI(GetNominalsOfContinuousStates)(fmi2Component c, fmi2Real values[], size_t n) {
    return (fmi2Status)nominals(c, values, n);
}

/* -- co-simulation -------------------------------------------------------------------------------- */

STATUS FMI(DoStep)(fmi2Component c, fmi2Real time, fmi2Real h, fmi2Boolean no_return) {
    (void)no_return;
    return (fmi2Status)advance(c, time, h);
}

STATUS FMI(SetRealInputDerivatives)(fmi2Component c, const fmi2ValueReference references[], size_t n,
                                    const fmi2Integer order[], const fmi2Real values[]) {
    (void)references, (void)order, (void)values;
    return n ? (fmi2Status)complain(c, FAILED, TITLE ": inputs are held during a step.") : fmi2OK;
}

STATUS FMI(GetRealOutputDerivatives)(fmi2Component c, const fmi2ValueReference references[], size_t n,
                                     const fmi2Integer order[], fmi2Real values[]) {
    (void)references, (void)order, (void)values;
    return n ? (fmi2Status)complain(c, FAILED, TITLE ": outputs have no derivatives here.") : fmi2OK;
}

STATUS FMI(CancelStep)(fmi2Component c) { return (fmi2Status)complain(c, FAILED, TITLE ": no step is under way."); }

STATUS FMI(GetRealStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Real *value) {
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = ((Instance *)c)->reached;
    return fmi2OK;
}

STATUS FMI(GetBooleanStatus)(fmi2Component c, fmi2StatusKind kind, fmi2Boolean *value) {
    (void)c;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = 1; /* asked after a step that failed: to repeat it would not help */
    return fmi2OK;
}

#define NO_STATUS(name, type)                                                    \
    STATUS FMI(name)(fmi2Component c, fmi2StatusKind kind, type *value) { \
        (void)c, (void)kind, (void)value;                                        \
        return fmi2Discard;                                                      \
    }

NO_STATUS(GetStatus, fmi2Status)
NO_STATUS(GetIntegerStatus, fmi2Integer)
NO_STATUS(GetStringStatus, fmi2String)
