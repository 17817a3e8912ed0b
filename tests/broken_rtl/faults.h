/* SPDX-License-Identifier: Apache-2.0
 *
 * What can be wrong with the pipeline that Vhalfstep.h beside this file pretends to be.
 */
#ifndef HS_TESTS_FAULTS_H
#define HS_TESTS_FAULTS_H

enum fault {
    FAULT_NONE,
    FAULT_IDENTITY,       /* the identity register is another's */
    FAULT_VERSION,        /* so is the stream version */
    FAULT_SILENT_BUS,     /* no register answers */
    FAULT_BUS_ERROR,      /* they answer SLVERR */
    FAULT_ASSERTION,      /* an assertion fails in the midst of a packet */
    FAULT_VALID_FALLS,    /* tvalid falls although the beat was not taken */
    FAULT_DATA_CHANGES,   /* tdata changes before the beat is taken */
    FAULT_LAST_CHANGES,   /* tlast does */
    FAULT_KEEP_CHANGES,   /* tkeep does */
    FAULT_OTHER_ID,       /* tid is not the view's */
    FAULT_KEEP_GAP,       /* a record in the midst of a beat is missing */
    FAULT_KEEP_PART,      /* half a record */
    FAULT_KEEP_EARLY,     /* a beat that is not full, and not the last */
    FAULT_BEAT_BEHIND,    /* a beat behind the last one, at once */
    FAULT_LATE_BEAT,      /* a beat behind the last one, a hundred cycles later */
    FAULT_DEAF,           /* takes no input */
    FAULT_MUTE,           /* gives no output */
    FAULT_ENDLESS,        /* gives output for ever */
    FAULT_STAYS_BUSY,     /* the busy register never falls */
    FAULT_CYCLES,         /* the cycle counter misses one */
    FAULT_ACTIVITY,       /* a cycle of split was neither busy nor idle */
    FAULT_ACTIVE_OUTSIDE, /* emit counts as busy where there is no view, and much */
    FAULT_ITEM_LOST,      /* select takes an item and gives none */
    FAULT_STATUS,         /* the registers tell of another status than the trailer */
    FAULT_POSITION,       /* of another word */
    FAULT_VIEWS,          /* the count of the views stands still */
    FAULT_WORD,           /* a bit of a word is wrong: for the comparison to find */
    FAULTS
};

/* The fault of all pipelines; changed between runs. */
#ifdef __cplusplus
extern "C" {
#endif
extern enum fault planted_fault;
#ifdef __cplusplus
}
#endif

#endif
