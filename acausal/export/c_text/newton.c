/* Newton's method for the stages of implicit steps; the Jacobian is kept while the iteration converges fast. */

static int lu_factor(real *a, int *p, const int n) {
    for (int k = 0; k < n; k++) {
        int r = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[r * n + k])) r = i;
        p[k] = r;
        if (!(fabs(a[r * n + k]) > 0)) return 0;
        if (r != k)
            for (int j = 0; j < n; j++) {
                const real swapped = a[k * n + j];
                a[k * n + j] = a[r * n + j];
                a[r * n + j] = swapped;
            }
        for (int i = k + 1; i < n; i++) {
            const real f = a[i * n + k] /= a[k * n + k];
            if (f != 0)
                for (int j = k + 1; j < n; j++) a[i * n + j] -= f * a[k * n + j];
        }
    }
    return 1;
}

static void lu_solve(const real *a, const int *p, real *b, const int n) {
    for (int k = 0; k < n; k++) {
        const real swapped = b[p[k]];
        b[p[k]] = b[k];
        b[k] = swapped;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) b[i] -= a[i * n + j] * b[j];
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) b[i] -= a[i * n + j] * b[j];
        b[i] /= a[i * n + i];
    }
}

/* Factors of 1 - h J at a point. */
static int factor(Model *m, const real t, const real *x, const real *u, const real h) {
    for (int j = 0; j < STATES; j++) {
        for (int i = 0; i < STATES; i++) m->seed[i] = 0;
        m->seed[j] = 1;
        jacobian_column(m, t, x, u, m->seed, m->scratch);
        for (int i = 0; i < STATES; i++) m->matrix[i * STATES + j] = (i == j) - h * m->scratch[i];
    }
    return lu_factor(m->matrix, m->pivots, STATES);
}

/* What is left of k = rates(t, from + h k), in m->scratch, and how much of the tolerance it is; beside the states
   themselves in m->remains. */
static real residual(Model *m, const real t, const real *u, const real h, const real *from, const real *k, real *x) {
    real size = 0;
    m->remains = 0;
    for (int i = 0; i < STATES; i++) x[i] = from[i] + h * k[i];
    rates(m, SIDED(t), x, u, m->scratch);
    for (int i = 0; i < STATES; i++) {
        m->scratch[i] -= k[i];
        const real part = fabs(h * m->scratch[i]) / TOLERANCE;
        if (!(part / (1 + fabs(from[i])) <= size)) size = part / (1 + fabs(from[i]));
        if (!(part / (LEAST + fabs(from[i])) <= m->remains)) m->remains = part / (LEAST + fabs(from[i]));
    }
    return size;
}

/* k = rates(t, from + h k). Where plain corrections fail, they begin anew, each halved until less is left. */
static int solve_stage(Model *m, const real t, const real *u, const real h, const real *from, real *k, real *x) {
    for (int damped = 0; damped < 2; damped++) {
        real size = INFINITY, rate = 1, before, tolerated, left, remains;
        int renew = damped;
        if (damped)
            for (int i = 0; i < STATES; i++) k[i] = 0;
        left = residual(m, t, u, h, from, k, x);
        for (int n = 0; n < STAGE_STEPS && isfinite(left); n++) {
            if (renew) {
                if (!factor(m, SIDED(t), x, u, h)) return 0;
                (void)residual(m, t, u, h, from, k, x);
            }
            for (int i = 0; i < STATES; i++) m->seed[i] = m->scratch[i];
            lu_solve(m->matrix, m->pivots, m->seed, STATES);
            remains = m->remains;
            real share = 1, found;
            for (int i = 0; i < STATES; i++) k[i] += m->seed[i];
            found = residual(m, t, u, h, from, k, x);
            while (damped && !(found < left) && share > R(1e-4)) {
                share /= 2;
                for (int i = 0; i < STATES; i++) k[i] -= share * m->seed[i];
                found = residual(m, t, u, h, from, k, x);
            }
            before = size;
            size = tolerated = 0;
            for (int i = 0; i < STATES; i++) {
                const real part = fabs(h * m->seed[i]) / TOLERANCE;
                if (!(share * part / (LEAST + fabs(x[i])) <= size)) size = share * part / (LEAST + fabs(x[i]));
                if (!(part / (1 + fabs(x[i])) <= tolerated)) tolerated = part / (1 + fabs(x[i]));
            }
            const real ratio = size / before, left_of = m->remains / remains;
            if (n > 0) rate = damped || ratio > R(0.3) * rate ? ratio : R(0.3) * rate;
            if (size == 0 || (share == 1 && size * (rate < 1 ? rate : 1) < KAPPA)) return 1;
            if (n > 1 && left_of > STALLS && left_of < GROWS && OF_STALL * tolerated < KAPPA) return 1;
            renew = damped || (n > 0 && ratio > SLOW);
            left = found;
        }
    }
    return 0;
}
