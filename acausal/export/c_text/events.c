/* -- events ---------------------------------------------------------------------------------------

   m->d are the discrete variables; the first GUARDS of them are conditions: 1 where they hold. Each has a number
   that is positive where it holds (or zero, unless it is strict). */

static int same(const real a, const real b) { return a == b || (a != a && b != b); }

static int equal(const real *a, const real *b, int n) {
    for (int i = 0; i < n; i++)
        if (!same(a[i], b[i])) return 0;
    return 1;
}

static void copy(const real *from, real *to, int n) {
    for (int i = 0; i < n; i++) to[i] = from[i];
}

/* Discrete variables from those of the iteration before, by number k, and the conditions' numbers: 1 if nothing changes.
   Those within their band of zero become what m->e.forced says. At first all that disagree change at once, later the
   first of them alone, and what is zero but for rounding stays, unless its time is known. */
static int once_more(Model *m, const real t, const real *u, const real *number, const real *band, const int k,
                     const real initial) {
    const int tens = k / DOUBTED < 6 ? k / DOUBTED : 6;
    const real rounding = tens ? pow(R(10.0), (real)(tens - 13)) : (real)-1;
    int others = 1;
    for (int i = 0; i < GUARDS; i++) {
        const real g = number[i];
        int holds = strict[i] ? g > 0 : g >= 0;
        if (!timed[i] && fabs(g) <= rounding) holds = m->d[i] > R(0.5);
        if (k < FORCED && fabs(g) <= band[i]) holds = m->e.forced[i];
        if (ticks[i] && initial > 0) holds = 0;
        m->e.holds[i] = (real)holds;
        if (m->e.holds[i] != m->d[i]) {
            if (!others && k >= ALL_AT_ONCE) m->e.holds[i] = m->d[i];
            others = 0;
        }
    }
    updated(m, t, m->x, u, m->e.x_before, m->e.d_before, m->e.holds, initial, m->e.next_d);
    const int done = equal(m->e.next_d, m->d, DISCRETE);
    copy(m->e.next_d, m->d, DISCRETE);
    return done;
}

/* Discrete variables that agree with all values, from m->x, m->d and those before; 0 if there are none.
   Conditions whose time comes with the event are what they are just behind it. */
static int iterate(Model *m, const real t, const real *u, const real initial) {
    for (int k = 0; k < ALL_AT_ONCE + ONE_BY_ONE; k++) {
        const real behind = t + COINCIDE * fabs(t);
        if (ANY_TIMED) conditions(m, behind, m->x, u, m->e.x_before, m->e.d_before, m->e.holds);
        conditions(m, t, m->x, u, m->e.x_before, m->e.d_before, m->e.number);
        for (int i = 0; i < GUARDS; i++)
            if (timed[i]) m->e.number[i] = m->e.holds[i];
        if (once_more(m, t, u, m->e.number, m->e.band, k, initial)) return 1;
    }
    return 0;
}

static int is_reset(const int condition) {
    for (int i = 0; i < RESETS; i++)
        if (resets[i][0] == condition) return 1;
    return 0;
}

/* A condition at zero becomes what its rate says; 0 if that was known. With an instant, all that pass zero within it do,
   in modes that agree with their rates; but for those that read what an event resets. */
static int switched(Model *m, const real t, const real *u, const real *along_u, const real instant) {
    const real behind = t + 16 * ROUNDING / COINCIDE * instant; /* inputs and known times may bend at t */
    int changed = 0, solved = 0;
#if EDGES
    if (instant > 0) find_edge(m, APART(fabs(t)));
#endif
    for (int k = 0; !solved && k < (instant > 0 ? ALL_AT_ONCE + ONE_BY_ONE : 1); k++) {
        rates(m, behind, m->x, u, m->e.dx_begin);
        conditions(m, behind, m->x, u, m->x, m->d, m->e.number);
        condition_rates(m, behind, m->x, u, m->e.dx_begin, along_u, m->e.rate);
        for (int i = 0; i < GUARDS; i++) {
            const real rate = m->e.rate[i], within = instant > 0 && !is_reset(i) ? instant * fabs(rate) : (real)-1;
            m->e.wide[i] = m->e.band[i];
            if (timed[i]) m->e.number[i] = m->d[i] - R(0.5); /* as it is */
            if (timed[i] || !(fabs(m->e.number[i]) <= fmax(m->e.band[i], within)) || !isfinite(rate) || rate == 0) continue;
            if (m->e.forced[i] != (rate > 0)) changed = 1;
            m->e.forced[i] = rate > 0;
            m->e.wide[i] = INFINITY;
        }
        if (instant > 0) solved = once_more(m, t, u, m->e.number, m->e.wide, k, 0);
    }
    if (instant > 0) copy(m->e.d_before, m->d, DISCRETE);
    if (solved) copy(m->e.wide, m->e.band, GUARDS);
    return changed || solved;
}

static int came_true(const Model *m, const int place) {
    return m->d[place] > R(0.5) && m->e.d_before[place] < R(0.5);
}

/* An event at m->x, m->d: all is found anew until nothing changes. Without along_u rates are not looked at; see
   switched for the instant. */
static Status fire(Model *m, const real t, const real *u, const real *along_u, const real instant) {
    int looked = !along_u;
    for (int pass = 0; pass < PASSES; pass++) {
        copy(m->x, m->e.x_before, STATES);
        copy(m->d, m->e.d_before, DISCRETE);
        if (!iterate(m, t, u, 0)) return STATUS_EVENT_ITERATION;
        int done = equal(m->d, m->e.d_before, DISCRETE);
        jumped(m, t, m->x, u, m->e.x_before, m->e.d_before, m->e.next_x);
        copy(m->e.next_x, m->x, STATES);
        for (int i = 0; i < RESETS; i++) /* it has set what it reads: its number counts from now on */
            if (came_true(m, resets[i][0]) && came_true(m, resets[i][1])) m->e.band[resets[i][0]] = -1;
        if (done && !looked) {
            looked = 1;
            done = !switched(m, t, u, along_u, instant);
        }
        if (done) return STATUS_OK;
    }
    return STATUS_EVENT_ITERATION;
}

/* When conditions change whose time is known: m->e.due, and how fast their numbers grow: m->e.rate. */
static void find_due(Model *m, const real *u) {
    if (!ANY_TIMED) {
        for (int i = 0; i < GUARDS; i++) m->e.due[i] = INFINITY, m->e.rate[i] = 0;
        return;
    }
    conditions(m, m->time, m->x, u, m->x, m->d, m->e.due);
    conditions(m, m->time + 1, m->x, u, m->x, m->d, m->e.number);
    for (int i = 0; i < GUARDS; i++) {
        m->e.rate[i] = m->e.number[i] - m->e.due[i];
        m->e.due[i] = timed[i] && m->e.rate[i] != 0 ? m->time - m->e.due[i] / m->e.rate[i] : INFINITY;
    }
}

/* Whether the time of a condition is still to come: it is later than what counts as now, or has not changed it yet. */
static int is_ahead(const Model *m, const int i, const real t, const real apart) {
    const int waits = (m->d[i] > R(0.5)) != (m->e.rate[i] > 0);
    return m->e.due[i] > t + apart || (waits && m->e.due[i] > t);
}

/* Conditions whose time has come change, whatever rounding makes of their numbers. */
static void force(Model *m, const real t, const real *u, const real apart) {
    find_due(m, u);
    for (int i = 0; i < GUARDS; i++) {
        const int near = fabs(m->e.due[i] - t) <= apart;
        m->e.band[i] = near ? 2 * apart * fabs(m->e.rate[i]) : (real)-1;
        m->e.forced[i] = m->e.rate[i] > 0;
    }
}

/* -- steps with events ---------------------------------------------------------------------------- */

/* Where a step is looked at; the state between its ends lies on the cubic through them. */
static void look_at_points(Model *m, const real t, const real h) {
    for (int k = 0; k < POINTS; k++) {
        const real s = (real)k / (POINTS - 1);
        const real *x = k == 0 ? m->x : k == POINTS - 1 ? m->e.x_end : m->e.x_before;
        if (x == m->e.x_before)
            for (int i = 0; i < STATES; i++) {
                const real ends = (1 - 2 * s) * (m->e.x_end[i] - m->x[i]);
                const real bend = ends + (s - 1) * h * m->e.dx_begin[i] + s * h * m->e.dx_end[i];
                m->e.x_before[i] = (1 - s) * m->x[i] + s * m->e.x_end[i] + s * (s - 1) * bend;
            }
        real u[INPUTS + 1] = {0};
        for (int i = 0; i < INPUTS; i++) u[i] = m->e.u_from[i] + s * (m->e.u_to[i] - m->e.u_from[i]);
        conditions(m, t + s * h, x, u, x, m->d, m->e.number + k * GUARDS);
    }
}

/* The next length to try: false position, sometimes the middle. */
static real next_length(const model_bracketing *bracketing) {
    real share = bracketing->off_low / (bracketing->off_low - bracketing->off_high);
    if (!isfinite(share) || bracketing->tries % (bracketing->off_low >= -CLOSE ? 2 : 6) == 1) share = R(0.5);
    else share = share < R(1e-9) ? R(1e-9) : share > 1 - R(1e-9) ? 1 - R(1e-9) : share;
    return bracketing->low + share * (bracketing->high - bracketing->low);
}

/* See whether conditions, whose time is not known, change in a step of length h: 1 if it ends there. */
static int look(Model *m, const real t, const real h) {
    model_bracketing *const bracketing = &m->e.bracketing;
    real off[POINTS];
    for (int k = 0; k < POINTS; k++) off[k] = -INFINITY;
    bracketing->which = 0;
    for (int i = 0; i < GUARDS; i++) {
        const int holds = m->d[i] > R(0.5);
        real over[POINTS];
        int touches[POINTS];
        for (int k = 0; k < POINTS; k++) {
            const real g = m->e.number[k * GUARDS + i];
            over[k] = (holds ? -g : g) - m->e.deadband[i]; /* positive where it is no longer what it was */
            touches[k] = over[k] == 0 && holds == strict[i];
            if (touches[k]) over[k] = TINY;
        }
        if (!bracketing->active) m->e.scale[i] = fabs(over[0]) + fabs(over[POINTS - 1]) + TINY;
        const int is_left = over[0] > 0 && over[0] <= BAND * m->e.scale[i] && !touches[0];
        if (is_left) /* what rounding has left of the event before */
            for (int k = POINTS - 1; k >= 0; k--) over[k] -= over[0];
        int later = bracketing->active && m->e.later[i];
        for (int k = 1; k < POINTS; k++) later = later || (over[k] > 0 && !timed[i]);
        m->e.later[i] = later;
        m->e.over[i] = over[POINTS - 1];
        if (!later) continue;
        for (int k = 0; k < POINTS; k++) {
            const real share = touches[k] ? CLOSE : over[k] / m->e.scale[i];
            if (!(share > off[k])) continue;
            off[k] = share;
            if (k == POINTS - 1) bracketing->which = i;
        }
    }
    if (!bracketing->active) {
        for (int k = 0; k + 1 < POINTS && !bracketing->active; k++) {
            if (!(off[k + 1] > 0)) continue;
            const real part = h / (POINTS - 1);
            *bracketing = (model_bracketing){.active = 1, .low = (real)k * part, .high = (real)(k + 1) * part,
                                .off_low = off[k] < 0 ? off[k] : 0, .off_high = off[k + 1], .away = off[k] < -CLOSE};
            bracketing->h = next_length(bracketing);
        }
        return 0;
    }
    const real value = off[POINTS - 1];
    const int above = value > 0;
    const real stays = above == bracketing->above && bracketing->tries > 0 ? R(0.5) : R(1.0);
    if (above) {
        bracketing->high = h;
        bracketing->off_low *= stays;
        bracketing->off_high = value;
    } else {
        bracketing->low = h;
        bracketing->off_low = value;
        bracketing->off_high *= stays;
    }
    bracketing->above = above;
    bracketing->tries++;
    bracketing->h = next_length(bracketing);
    const real size = fabs(t) > h ? fabs(t) : h;
    const int close = fabs(value) <= CLOSE && value != 0 && bracketing->away; /* not what is left of the event before */
    bracketing->away = bracketing->away || value < -CLOSE;
    if (!(close || bracketing->high - bracketing->low <= 4 * ROUNDING * size || bracketing->tries >= TRIES))
        return 0;
    bracketing->active = 0;
    for (int i = 0; i < GUARDS; i++) {
        const int near = m->e.later[i] && m->e.over[i] >= -BAND * m->e.scale[i];
        m->e.band[i] = near || i == bracketing->which ? BAND * m->e.scale[i] : (real)-1;
        m->e.forced[i] = m->d[i] < R(0.5);
    }
    return 1;
}

/* An event at m->time, where the step led to m->e.x_end. */
static Status end_with_event(Model *m, const real *u, const real *along_u, const int searched, const real span) {
    copy(m->e.x_end, m->x, STATES);
    copy(m->d, m->e.d_last, DISCRETE);
    for (int i = 0; i < GUARDS; i++) m->e.touched[i] = m->e.band[i];
    const int near = m->time - m->e.last_event < NEAR * span, too_many = near && m->e.chattering + 1 >= CHATTERING;
    const Status status = fire(m, m->time, u, along_u, too_many ? COINCIDE * fmax(fabs(m->time), span) : 0);
    if (status) return status;
    /* an event that rounding has made changes nothing: the number must go farther next time */
    const int moved = !searched || !equal(m->d, m->e.d_last, DISCRETE) || !equal(m->x, m->e.x_end, STATES);
    for (int i = 0; i < GUARDS; i++) {
        const real grown = DEADBAND_GROWTH * m->e.deadband[i];
        const real farther = grown > m->e.touched[i] ? grown : m->e.touched[i];
        m->e.deadband[i] = moved ? 0 : m->e.touched[i] >= 0 ? farther : m->e.deadband[i];
    }
    if (moved) {
        m->e.chattering = near ? m->e.chattering + 1 : 0;
        m->e.last_event = m->time;
    }
    return m->e.chattering >= CHATTERING + BY_RATES ? STATUS_CHATTERING : STATUS_OK;
}

/* Divided at events. */
Status model_step(Model *m, const real h, const real *u_end) {
    const real begin = m->time, end = begin + h;
    for (int i = 0; i < INPUTS; i++) {
        m->e.u_begin[i] = m->u[i];
        m->e.along_u[i] = u_end ? (u_end[i] - m->u[i]) / h : 0;
    }
    m->e.bracketing.active = 0;
    while (m->time < end) {
        const real t = m->time, apart = COINCIDE * (fabs(t) > h ? fabs(t) : h);
        real stop = end, soonest = INFINITY;
        for (int i = 0; i < INPUTS; i++)
            m->e.u_from[i] = m->e.u_begin[i] + (t - begin) * m->e.along_u[i];
        find_due(m, m->e.u_from);
        for (int i = 0; i < GUARDS; i++)
            if (is_ahead(m, i, t, apart) && m->e.due[i] < soonest) soonest = m->e.due[i];
        int is_timed = soonest <= stop + apart;
        if (is_timed) stop = soonest;
#if EDGES
        find_edge(m, apart);
        if (m->until < stop - apart) stop = m->until, is_timed = 0;
#endif
        for (int i = 0; i < GUARDS; i++) {
            if (!is_ahead(m, i, t, apart)) m->e.due[i] = INFINITY;
            m->e.rounding[i] = 2 * apart * fabs(m->e.rate[i]);
            m->e.band[i] = is_timed && m->e.due[i] <= soonest + apart ? m->e.rounding[i] : (real)-1;
            m->e.forced[i] = m->d[i] < R(0.5);
        }
        const int searching = m->e.bracketing.active;
        const real length = searching ? m->e.bracketing.h : stop - t;
        for (int i = 0; i < INPUTS; i++)
            m->e.u_to[i] = m->e.u_begin[i] + (t + length - begin) * m->e.along_u[i];
        Status status = attempt(m, t, length);
        if (status && !searching) return status;
        look_at_points(m, t, length);
        const int found = look(m, t, length);
        if (m->e.bracketing.active) continue;
        status = STATUS_OK;
        if (found) {
            m->time = t + length;
            for (int i = 0; i < GUARDS; i++) { /* what is due just now would be missed after it */
                const int is_due = fabs(m->e.due[i] - m->time) <= apart;
                if (is_due && m->e.rounding[i] > m->e.band[i]) m->e.band[i] = m->e.rounding[i];
            }
            status = end_with_event(m, m->e.u_to, m->e.along_u, 1, h);
        } else if (is_timed) {
            m->time = stop;
            status = end_with_event(m, m->e.u_to, m->e.along_u, 0, h);
        } else {
            m->time = stop;
            copy(m->e.x_end, m->x, STATES);
        }
        if (status) return status;
    }
    m->time = end;
    for (int i = 0; i < INPUTS; i++) m->u[i] = u_end ? u_end[i] : m->e.u_begin[i];
    return STATUS_OK;
}

/* What discrete variables begin with. */
static void begin_modes(Model *m) {
#if DISCRETE_STARTS
    discrete_starts(m, m->d);
#else
    fill_d(m->d);
#endif
}

/* Discrete variables that agree with m->x, as they are before the first event; 0 if there are none. */
static int find_modes(Model *m) {
    begin_modes(m);
    for (int i = 0; i < GUARDS; i++) m->e.band[i] = -1;
    copy(m->x, m->e.x_before, STATES);
    copy(m->d, m->e.d_before, DISCRETE);
    return iterate(m, m->time, m->u, 1);
}

Status model_begin(Model *m) {
    for (int i = 0; i < GUARDS; i++) m->e.deadband[i] = m->e.usual[i] = 0;
    m->e.chattering = 0;
    m->e.last_event = -INFINITY;
    if (!find_modes(m)) return STATUS_EVENT_ITERATION;
    force(m, m->time, m->u, COINCIDE * fabs(m->time));
    return fire(m, m->time, m->u, NULL, 0);
}

Status model_event(Model *m) {
    force(m, m->time, m->u, COINCIDE * fabs(m->time));
    conditions(m, m->time, m->x, m->u, m->x, m->d, m->e.number);
    for (int i = 0; i < GUARDS; i++) {
        const int was_away = !timed[i] && m->e.usual[i] > 0;
        if (was_away && fabs(m->e.number[i]) <= BAND * m->e.usual[i]) {
            m->e.band[i] = BAND * m->e.usual[i];
            m->e.forced[i] = m->d[i] < R(0.5);
        }
        m->e.usual[i] = 0;
    }
    for (int i = 0; i < INPUTS; i++) m->e.along_u[i] = 0;
    return fire(m, m->time, m->u, m->e.along_u, 0);
}

Status model_conditions(Model *m) {
    conditions(m, m->time, m->x, m->u, m->x, m->d, m->e.number);
    return all_finite(m->e.number, GUARDS) ? STATUS_OK : STATUS_NOT_FINITE;
}

void model_completed(Model *m) {
    conditions(m, m->time, m->x, m->u, m->x, m->d, m->e.number);
    for (int i = 0; i < GUARDS; i++)
        if (fabs(m->e.number[i]) > m->e.usual[i]) m->e.usual[i] = fabs(m->e.number[i]);
}

real model_next_event(Model *m) {
    real soonest = INFINITY;
#if EDGES
    find_edge(m, APART(fabs(m->time)));
    soonest = m->until;
#endif
    find_due(m, m->u);
    for (int i = 0; i < GUARDS; i++)
        if (is_ahead(m, i, m->time, COINCIDE * fabs(m->time)) && m->e.due[i] < soonest) soonest = m->e.due[i];
    return soonest;
}
