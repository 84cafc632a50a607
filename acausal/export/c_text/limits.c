/* A step ends with states that are finite and have not run away; m->broken is the first that does not. */
static Status within_limits(Model *m, const real *x) {
    for (int i = 0; i < STATES; i++) {
        if (fabs(x[i]) < LIMIT(i)) continue;
        m->broken = i;
        return isfinite(x[i]) ? STATUS_RUN_AWAY : STATUS_NOT_FINITE;
    }
    return STATUS_OK;
}
