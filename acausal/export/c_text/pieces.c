/* Divided at edges. */
Status model_step(Model *m, const real h, const real *u_end) {
    const real begin = m->time, end = begin + h, apart = APART(fabs(end) > h ? fabs(end) : h);
    real from[INPUTS + 1], to[INPUTS + 1];
    for (int i = 0; i < INPUTS; i++) from[i] = m->u[i];
    while (m->time < end) {
        find_edge(m, apart);
        const real stop = m->until < end - apart ? m->until : end, share = (stop - begin) / h;
        for (int i = 0; i < INPUTS; i++) to[i] = from[i] + share * ((u_end ? u_end[i] : from[i]) - from[i]);
        const Status status = piece(m, stop - m->time, to);
        m->time = stop;
        if (status) return status;
    }
    return STATUS_OK;
}

real model_next_event(Model *m) {
    find_edge(m, APART(fabs(m->time)));
    return m->until;
}
