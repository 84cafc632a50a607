/* The functions that FMI 2.0 and 3.0 have alike.

   The file that includes this one defines the types Status, Truth and Byte, and how the functions are called of which the
   two have other names: OF_STATE(verb, rest), DESERIALIZE and GET_RATES. */
#define STATUS FMI_EXPORT Status

/* -- common --------------------------------------------------------------------------------------- */

STATUS FMI(SetDebugLogging)(void *c, Truth on, size_t n, const char *const categories[]) {
    (void)c, (void)on, (void)n, (void)categories; /* only failures are logged, and always */
    return (Status)OK;
}

static Instance *instantiate(const Host *host, const char *token, int possible) {
    Instance *c = calloc(1, sizeof(Instance));
    if (!c) return NULL;
    c->host = *host;
    if (!token || strcmp(token, TOKEN) != 0)
        complain(c, FAILED, TITLE ": the token is not that of this binary; unpack the FMU again.");
    else if (!possible)
        complain(c, FAILED, TITLE ": this FMU was not exported for this kind of use.");
    else {
        start(c);
        return c;
    }
    free(c);
    return NULL;
}

FMI_EXPORT void FMI(FreeInstance)(void *c) { free(c); }

#define NOTHING(name)            \
    STATUS FMI(name)(void *c) {  \
        (void)c;                 \
        return (Status)OK;               \
    }

NOTHING(Terminate)

STATUS FMI(ExitInitializationMode)(void *c) { return (Status)end_start(c); }

STATUS FMI(Reset)(void *c) {
    start(c);
    return (Status)OK;
}

/* -- the state of the FMU --------------------------------------------------------------------------- */

STATUS OF_STATE(Get, )(void *c, void **state) { return (Status)keep(c, state); }

STATUS OF_STATE(Set, )(void *c, void *state) { return (Status)restore(c, state); }

STATUS OF_STATE(Free, )(void *c, void **state) {
    (void)c;
    return (Status)forget(state);
}

STATUS OF_STATE(Serialized, Size)(void *c, void *state, size_t *size) {
    (void)c, (void)state;
    *size = sizeof(State);
    return (Status)OK;
}

STATUS OF_STATE(Serialize, )(void *c, void *state, Byte bytes[], size_t size) {
    return (Status)serialize(c, state, bytes, size);
}

STATUS DESERIALIZE(void *c, const Byte bytes[], size_t size, void **state) {
    return (Status)deserialize(c, bytes, size, state);
}

/* -- model exchange ------------------------------------------------------------------------------- */

STATUS FMI(EnterEventMode)(void *c) { return (Status)hold_outside(c, 0); }

STATUS FMI(EnterContinuousTimeMode)(void *c) { return (Status)hold_outside(c, 1); }

STATUS FMI(CompletedIntegratorStep)(void *c, Truth no_return, Truth *event, Truth *end) {
    (void)no_return;
    completed(c);
    *event = outside_changes(c) != 0;
    *end = 0;
    return (Status)OK;
}

STATUS FMI(SetTime)(void *c, double time) {
    begin(c, time);
    return (Status)OK;
}

STATUS FMI(SetContinuousStates)(void *c, const double x[], size_t n) {
    return (Status)each_state(c, STATES, NULL, x, n);
}

STATUS FMI(GetContinuousStates)(void *c, double x[], size_t n) {
    return (Status)each_state(c, STATES, x, NULL, n);
}

STATUS GET_RATES(void *c, double dx[], size_t n) { return (Status)each_state(c, DERIVATIVES, dx, NULL, n); }

STATUS FMI(GetEventIndicators)(void *c, double indicators[], size_t n) {
    return (Status)get_indicators(c, indicators, n);
}

STATUS FMI(GetNominalsOfContinuousStates)(void *c, double values[], size_t n) {
    return (Status)nominals(c, values, n);
}
