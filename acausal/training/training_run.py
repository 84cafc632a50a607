"""The loop of a training: chunks of updates with evaluations in between, until the planned end or Ctrl-C."""

from __future__ import annotations

import itertools
import logging
import math
import time
from collections.abc import Generator, Sequence
from contextlib import closing
from statistics import fmean as mean

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, PRNGKeyArray

from acausal.errors import TrainingError
from acausal.training.checkpoint import Keep, Snapshot, Stored
from acausal.training.history import Divergence
from acausal.training.member import Best, Member, Trained, stacked, unstacked
from acausal.training.objective.problem import Problem
from acausal.training.objective.sharding import of_first_process, on_default_device, replicate
from acausal.training.objective.trainable import Trainable
from acausal.training.optimizers.trainer import (
    UPDATES_PER_CALL,
    State,
    UpdateLog,
    advance,
    begin,
    candidates,
    converged,
    epochs_of,
)
from acausal.training.progress import Observer, Progress
from acausal.training.read_ahead import Ready, read_ahead
from acausal.training.rejections import too_many
from acausal.training.starts import Halving
from acausal.training.strategy import Segment

LOGGER = logging.getLogger(__name__)

REPORT_EVERY = 0.5
"""Approximate seconds between two reports to the observers."""


class TrainingRun:
    """Trainings of one problem that run in one program: segment by segment, each from the best state of the one before.

    Arguments:
        problem: evaluated over the whole record; the best evaluation is chosen where nothing is held out.
        segments: what to minimise and how. A segment ends when it has ended for all trainings.
        keys: sources of all batches, one for each training.
        observers: called about twice a second. A `KeyboardInterrupt` in one ends the training as Ctrl-C does.
        keep: called with all that is needed to continue, before the first update and after every few.
        held: what is held out; the best is the one with the lowest loss over it.
        halving: which trainings go on to the end.

    Attributes:
        candidates: for the best: what is trained, and what else the optimizer knows.
    """

    candidates: tuple[Trainable, ...]

    def __init__(
        self,
        problem: Problem,
        segments: Sequence[Segment],
        keys: Sequence[PRNGKeyArray],
        observers: Sequence[Observer],
        keep: Keep,
        held: Problem | None,
        halving: Halving,
    ) -> None:
        self.began = time.perf_counter()
        self.mesh = problem.mesh
        on_devices = replicate((problem, held), self.mesh)
        self.members = [Member(*on_devices, key) for key in keys]
        self.segments, self.observers, self.keep = segments, observers, keep
        self.halving = halving
        self.planned = [0, *itertools.accumulate(segment.epochs for segment in segments)]
        self.epochs = self.planned[-1]
        self.compiling = self.updating = 0.0
        self.evaluated = self.last = -1
        self.before = self.done = 0
        self.going = list(range(len(keys)))
        self.converged = [False] * len(keys)

    def train(self, starts: Sequence[Trainable], stored: Stored | None) -> tuple[Trained, ...]:
        """Train until the last segment ends or the user interrupts.

        Arguments:
            starts: where each training begins.
            stored: the checkpoint to continue from; ``None`` to start anew.

        Raises:
            TrainingError: if `REJECTIONS` updates in a row had to be rejected, in a stage that may not fail.
            DataError: if the checkpoint belongs to another training.
        """
        interrupted = False
        if stored is None:
            self.candidates = (replicate(stacked(starts), self.mesh),)
            self.evaluate()
            first, state = 0, None
        else:
            first, state = self.resume(stored, starts)
        try:
            for i in range(first, len(self.segments)):
                above = self.segments[i].stage.above if state is None else 0.0
                if above > 0 and all(m.best.loss <= above * m.noise() for m in self.members):
                    continue
                self.follow(i, self.enter(i) if state is None else state)
                state = None
        except KeyboardInterrupt:
            interrupted = True
            self.evaluate()
        seconds = time.perf_counter() - self.began
        times = seconds, self.compiling, self.updating
        return tuple(
            Trained(
                member.best,
                member.simulated,
                end,
                member.log.history(),
                *times,
                interrupted,
                member.failed,
                finished=not interrupted
                and member.failed is None
                and (k in self.going or self.converged[k]),
            )
            for k, (member, end) in enumerate(
                zip(self.members, unstacked(self.candidates[0], len(self.members)), strict=True)
            )
        )

    def resume(self, stored: Stored, starts: Sequence[Trainable]) -> tuple[int, State]:
        """Restore a training; returns its segment and the trainer's state."""
        validation = None if self.members[0].held is None else 0.0
        bests = tuple(Best(0.0, validation, 0, start) for start in starts)
        state = self._begin(stored.segment, starts)
        like = Snapshot(stored.segment, 0, state, bests, 0, 0.0, 0.0, 0.0)
        snapshot = replicate(stored.snapshot(like), self.mesh)
        for member, columns, best in zip(self.members, stored.columns, snapshot.bests, strict=True):
            member.log.go_on(columns)
            member.best, member.simulated = best, member.problem.simulate(best.trainable)
        self.candidates = candidates(snapshot.state)
        self.before, self.evaluated = snapshot.before, snapshot.evaluated
        epochs = epochs_of(snapshot.state)
        self.done = self.before + max(epochs)
        self._note_failed(stored.segment, snapshot.state)
        self._note_converged(stored.segment, snapshot.state)
        for member, count in zip(self.members, epochs, strict=True):
            member.before = member.log.epochs - count
        self.began -= snapshot.seconds
        self.compiling, self.updating = snapshot.compiling, snapshot.updating
        return stored.segment, snapshot.state

    def enter(self, i: int) -> State:
        """The trainer's state at the start of a segment."""
        self.before = self.done
        entries = [m.best.trainable for m in self.members]
        if i and self.segments[i - 1].stage.onward and self.last == i - 1:
            ends = unstacked(self.candidates[-1], len(self.members))
            ended = zip(self.members, entries, ends, strict=True)
            entries = [best if m.failed is not None else end for m, best, end in ended]
        for member in self.members:
            member.before, member.failed = member.log.epochs, None
        return replicate(self._begin(i, entries), self.mesh)

    def _begin(self, i: int, entries: Sequence[Trainable]) -> State:
        segment = self.segments[i]
        keys = [jax.random.fold_in(m.key, i) if i else m.key for m in self.members]
        begins = [
            begin(
                segment.trainer, on_default_device(segment.objective.entry(entry), self.mesh), key
            )
            for entry, key in zip(entries, keys, strict=True)
        ]
        return stacked(begins)

    def follow(self, i: int, state: State) -> None:
        """Do the remaining updates of a segment."""
        segment, self.last = self.segments[i], i
        self._choose(i)
        self._keep(i, state)
        objective = replicate(segment.objective, self.mesh)
        done = self.done - self.before
        with closing(read_ahead(objective, state.key, done, segment.epochs)) as ahead:
            self._update(i, state, ahead)

    def _update(self, i: int, state: State, ahead: Generator[Ready]) -> None:
        segment, ready = self.segments[i], Ready(self.segments[i].objective, 0)
        if self.done - self.before < segment.epochs:
            ready = next(ahead)
            clock = time.perf_counter()
            # This compiles, and makes no update.
            until = jnp.max(state.epoch)
            jax.block_until_ready(
                advance(ready.problem, segment.trainer, state, until, active=self._active())
            )
            self.compiling += time.perf_counter() - clock
        size = 1
        while (done := self.done - self.before) < segment.epochs and not self._is_over(
            segment, state
        ):
            due = min((done // segment.evaluate_every + 1) * segment.evaluate_every, segment.epochs)
            due = min(due, done + self.halving.until_next(self.planned[i] + done))
            ready = ready if done < ready.until else next(ahead)
            count = min(size, int(min(due, ready.until)) - done, UPDATES_PER_CALL)
            clock = time.perf_counter()
            until = replicate(jnp.asarray(done + count, int), self.mesh)
            before = state
            state, entries = jax.block_until_ready(
                advance(ready.problem, segment.trainer, state, until, active=self._active())
            )
            ended = time.perf_counter()
            count = max(epochs_of(state)) - done
            new = self._log(before, state, entries, clock - self.began, ended - self.began)
            self._note_converged(i, state)
            per_epoch = of_first_process((ended - clock) / count, self.mesh)
            self.updating += ended - clock
            size = max(1, min(UPDATES_PER_CALL, int(REPORT_EVERY / per_epoch)))
            if done + count == due:
                self.evaluate()
            self._choose(i)
            self._keep(i, state)
            counted = self.members[self.going[0]].log.evaluations[-1].events
            progress = Progress(
                self.done,
                self.epochs,
                mean(self.members[k].log.loss for k in self.going),
                mean(self.members[k].best.score for k in self.going),
                ended - self.began,
                per_epoch,
                tuple(new),
                sum(counted) if counted else None,
            )
            for observe in self.observers:
                observe(progress)
        self.evaluate()
        self._keep(i, state)

    def _choose(self, i: int) -> None:
        """Choose the trainings that go on; their number depends on the updates that were planned up to now."""
        done = self.planned[i] + self.done - self.before
        self.going = self.halving.survivors([m.best.score for m in self.members], done)

    def _note_converged(self, i: int, state: State) -> None:
        ended = unstacked(converged(state), len(self.members))
        self.converged = [bool(c) and i == len(self.segments) - 1 for c in ended]

    def _active(self) -> Bool[Array, " trainings"] | None:
        """Which trainings go on; ``None`` where there is only one."""
        if len(self.members) == 1:
            return None
        return jnp.zeros(len(self.members), bool).at[np.asarray(self.going)].set(True)

    def _log(
        self, before: State, state: State, entries: UpdateLog, started: float, ended: float
    ) -> list[Divergence]:
        """Log some updates; returns what diverged."""
        size, new = len(self.members), []
        counts = [b - a for a, b in zip(epochs_of(before), epochs_of(state), strict=True)]
        for k, entry in enumerate(unstacked(jax.tree.map(np.asarray, entries), size, axis=1)):
            if counts[k]:
                new += self.members[k].log.add(entry, counts[k], started, ended, self.last)
        self._note_failed(self.last, state)
        self.done += max(counts)
        self.candidates = candidates(state)
        return new

    def _note_failed(self, i: int, state: State) -> None:
        """Note for which trainings too many updates were rejected in a row."""
        size, stage = len(self.members), self.segments[i].stage
        rejected = [int(r) for r in unstacked(state.rejected, size)]
        if self.halving.rungs:  # one that diverges ends no other
            rejected = [min(rejected[k] for k in self.going)] * size
        for member, count, tried in zip(
            self.members, rejected, unstacked(state.trainable, size), strict=True
        ):
            member.failed = too_many(member.log, count, member.problem, tried)
            if member.failed is not None and not stage.may_fail:
                raise TrainingError(member.failed)
            if member.failed is not None:
                LOGGER.info("%s has ended: %s", stage.title, member.failed)

    def _keep(self, segment: int, state: State) -> None:
        """Pass all that is needed to continue from here to ``keep``."""
        seconds = time.perf_counter() - self.began
        bests = tuple(m.best for m in self.members)
        snapshot = Snapshot(
            segment,
            self.before,
            state,
            bests,
            self.evaluated,
            seconds,
            self.compiling,
            self.updating,
        )
        self.keep(snapshot, tuple(m.log.rows() for m in self.members))

    def evaluate(self) -> None:
        """Evaluate the candidates of every member, which keeps one if it is the best so far."""
        if self.evaluated == self.done:
            return
        self.evaluated = self.done
        rows = [unstacked(c, len(self.members)) for c in self.candidates]
        for k in self.going:
            self.members[k].evaluate([row[k] for row in rows])

    def _is_over(self, segment: Segment, state: State) -> bool:
        """Whether a segment has converged, or has not improved for too long, for all members."""
        ended = unstacked(converged(state), len(self.members))
        patience = math.inf if segment.patience is None else segment.patience
        return all(
            bool(ended[k])
            or self.members[k].failed is not None
            or self.members[k].evaluations_without_improvement() >= patience
            or self.members[k].gained_less(segment.stage.gain)
            for k in self.going
        )
