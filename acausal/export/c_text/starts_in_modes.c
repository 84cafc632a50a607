/* Start values that depend on discrete variables, and these on them: both are found in turn until nothing changes. */
static int find_states(Model *m) {
    starts(m, m->time, m->u, m->x);
    return all_finite(m->x, STATES);
}

Status model_start(Model *m) {
    guesses(m, m->x);
    (void)find_modes(m);
    if (!find_states(m)) { /* there may be some in the modes that are declared */
        begin_modes(m);
        if (!find_states(m)) return STATUS_NOT_FINITE;
    }
    for (int k = 0; k < STARTS_IN_TURN; k++) {
        copy(m->x, m->e.x_end, STATES);
        copy(m->d, m->e.d_last, DISCRETE);
        (void)find_modes(m);
        if (!find_states(m)) return STATUS_NOT_FINITE;
        if (equal(m->d, m->e.d_last, DISCRETE) && equal(m->x, m->e.x_end, STATES)) return STATUS_OK;
    }
    return equal(m->d, m->e.d_last, DISCRETE) ? STATUS_OK : STATUS_EVENT_ITERATION; /* x creeps by rounding */
}
