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

typedef fmi2Status Status;
typedef fmi2Boolean Truth;
typedef fmi2Byte Byte;

#define OF_STATE(verb, rest) FMI(verb##FMUstate##rest)
#define DESERIALIZE FMI(DeSerializeFMUstate)
#define GET_RATES FMI(GetDerivatives)
#include "fmu_functions.h"

/* -- common --------------------------------------------------------------------------------------- */

FMI_EXPORT const char *FMI(GetTypesPlatform)(void) { return "default"; }

FMI_EXPORT const char *FMI(GetVersion)(void) { return "2.0"; }

FMI_EXPORT fmi2Component FMI(Instantiate)(fmi2String name, fmi2Type type, fmi2String token, fmi2String resources,
                                          const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                                          fmi2Boolean logging) {
    (void)resources, (void)visible, (void)logging;
    Host host = {0};
    if (functions) {
        host.logger = functions->logger;
        host.environment = functions->componentEnvironment;
    }
    snprintf(host.name, sizeof host.name, "%s", name ? name : "");
    return instantiate(&host, token, type == fmi2ModelExchange ? MODEL_EXCHANGE : CO_SIMULATION);
}

STATUS FMI(SetupExperiment)(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real time,
                            fmi2Boolean has_end, fmi2Real end) {
    (void)has_tolerance, (void)tolerance, (void)has_end, (void)end;
    begin(c, time);
    return fmi2OK;
}

NOTHING(EnterInitializationMode)
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

/* -- derivatives ---------------------------------------------------------------------------------- */

STATUS FMI(GetDirectionalDerivative)(fmi2Component c, const fmi2ValueReference unknowns[], size_t n_unknowns,
                                     const fmi2ValueReference knowns[], size_t n_knowns, const fmi2Real seed[],
                                     fmi2Real result[]) {
    return (fmi2Status)directional(c, unknowns, n_unknowns, knowns, n_knowns, seed, n_knowns, result, n_unknowns);
}

/* -- model exchange ------------------------------------------------------------------------------- */

STATUS FMI(NewDiscreteStates)(fmi2Component c, fmi2EventInfo *info) {
    int changed, timed;
    memset(info, 0, sizeof *info);
    const int status = update(c, &changed, &timed, &info->nextEventTime);
    info->valuesOfContinuousStatesChanged = changed;
    info->nextEventTimeDefined = timed;
    return (fmi2Status)status;
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
