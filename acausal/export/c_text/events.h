/* The search for the instant of an event. */
typedef struct {
    int active, tries, above, away, which;
    model_real h, low, high, off_low, off_high;
} model_bracketing;

/* What steps with events need. number: of each condition, positive where it holds, at five points of a step. */
typedef struct {
    model_real number[5 * MODEL_CONDITIONS + 1], rate[MODEL_CONDITIONS + 1], due[MODEL_CONDITIONS + 1],
        rounding[MODEL_CONDITIONS + 1];
    model_real band[MODEL_CONDITIONS + 1], touched[MODEL_CONDITIONS + 1], deadband[MODEL_CONDITIONS + 1],
        usual[MODEL_CONDITIONS + 1], wide[MODEL_CONDITIONS + 1];
    model_real scale[MODEL_CONDITIONS + 1], over[MODEL_CONDITIONS + 1], holds[MODEL_CONDITIONS + 1];
    int later[MODEL_CONDITIONS + 1], forced[MODEL_CONDITIONS + 1], chattering;
    model_real last_event, d_before[MODEL_DISCRETE], d_last[MODEL_DISCRETE], next_d[MODEL_DISCRETE];
    model_real x_before[MODEL_STATES + 1], next_x[MODEL_STATES + 1], x_end[MODEL_STATES + 1],
        dx_begin[MODEL_STATES + 1], dx_end[MODEL_STATES + 1];
    model_real u_begin[MODEL_INPUTS + 1], u_from[MODEL_INPUTS + 1], u_to[MODEL_INPUTS + 1], along_u[MODEL_INPUTS + 1];
    model_bracketing bracketing;
} model_events;
