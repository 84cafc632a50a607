/* At an edge the rates are those of the side on which a step lies: between m->since and m->until. */
static real sided(const Model *m, const real t) {
    const real begin = APART(fabs(m->since)), end = APART(fabs(m->until));
    if (isfinite(m->since) && fabs(t - m->since) <= begin) return t + 2 * begin;
    if (isfinite(m->until) && fabs(t - m->until) <= end) return t - 2 * end;
    return t;
}
#define SIDED(t) sided(m, t)

/* m->until: the next time at which the rates jump or bend. */
static void find_edge(Model *m, const real apart) {
    real edge[2];
    ahead(m, m->time, apart, edge);
    m->since = m->time;
    m->until = edge[0] < edge[1] ? edge[0] : edge[1];
}
