void model_init(Model *m) {
    m->time = 0;
#if EDGES
    m->since = -INFINITY, m->until = INFINITY;
#endif
    fill_p(m->p);
    fill_x(m->x);
#if EVENTS
    fill_d(m->d);
#endif
    for (int i = 0; i < INPUTS; i++) m->u[i] = 0;
    recalibrate(m);
}

#if !STARTS_IN_MODES
Status model_start(Model *m) {
#if STARTS
    starts(m, m->time, m->u, m->x);
    return all_finite(m->x, STATES) ? STATUS_OK : STATUS_NOT_FINITE;
#else
    fill_x(m->x);
    return STATUS_OK;
#endif
}
#endif

Status model_recalibrate(Model *m) {
    recalibrate(m);
    return all_finite(m->known, KNOWN) ? STATUS_OK : STATUS_NOT_FINITE;
}

Status model_derivatives(Model *m) {
    rates(m, SIDED(m->time), m->x, m->u, m->dx);
    return all_finite(m->dx, STATES) ? STATUS_OK : STATUS_NOT_FINITE;
}

Status model_outputs(Model *m) {
    outputs(m, m->time, m->x, m->u, m->y);
    return all_finite(m->y, OUTPUTS) ? STATUS_OK : STATUS_NOT_FINITE;
}

#if TANGENT
Status model_directional(Model *m, const real along_time, const real *along_x, const real *along_u,
    const real *along_p, real *of_dx, real *of_y) {
    tangent(m, m->time, m->x, m->u, along_time, along_x, along_u, along_p, of_dx, of_y);
    return all_finite(of_dx, STATES) && all_finite(of_y, OUTPUTS) ? STATUS_OK : STATUS_NOT_FINITE;
}

#endif
#if WATCHES
int model_outside(Model *m) { /* what is no number lies outside */
    real found = 0;
    excess(m, m->time, m->x, m->u, &found);
    return !(found <= 0);
}

#endif
