//! Work on many things at once whose results are wanted in their order.

use std::ops::ControlFlow;
use std::sync::mpsc::channel;
use std::sync::{Condvar, Mutex, PoisonError};

/// Results that may wait for an earlier one: a large program among small ones does not hold back the other processors
/// for long, and what waits stays small.
const AHEAD: usize = 256;

/// What the workers share.
struct Queue {
    next: usize,
    taken: usize,
    stopped: bool,
}

/// Does `work` for `0..count` on `threads` threads and hands the results to `take` one by one in order.
///
/// When a result `is_last`, or `take` breaks, no further work begins; what had begun is finished and handed over, so
/// that nothing is done that nobody hears of.
pub fn in_order<R: Send>(
    threads: usize,
    count: usize,
    work: impl Fn(usize) -> R + Sync,
    is_last: impl Fn(&R) -> bool + Sync,
    mut take: impl FnMut(usize, R) -> ControlFlow<()>,
) {
    let queue = Mutex::new(Queue { next: 0, taken: 0, stopped: false });
    let changed = Condvar::new();
    let lock = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    // The next piece of work, once it is not too far ahead.
    let begin = || {
        let far_ahead = |queue: &mut Queue| !queue.stopped && queue.next < count && queue.next >= queue.taken + AHEAD;
        let mut queue = changed.wait_while(lock(), far_ahead).unwrap_or_else(PoisonError::into_inner);
        let index = queue.next;
        queue.next += 1;
        (!queue.stopped && index < count).then_some(index)
    };
    let stop = || {
        lock().stopped = true;
        changed.notify_all();
    };
    let (send, receive) = channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.min(count) {
            let (send, begin, work, is_last, stop) = (send.clone(), &begin, &work, &is_last, &stop);
            scope.spawn(move || {
                while let Some(index) = begin() {
                    let result = work(index);
                    if is_last(&result) {
                        stop();
                    }
                    if send.send((index, result)).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        let mut waiting = std::collections::BTreeMap::new();
        let mut wanted = 0;
        for (index, result) in receive {
            waiting.insert(index, result);
            while let Some(result) = waiting.remove(&wanted) {
                if take(wanted, result).is_break() {
                    stop();
                }
                wanted += 1;
                lock().taken = wanted;
                changed.notify_all();
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn results_come_in_order_whatever_takes_longest() {
        let mut seen = Vec::new();
        let slow_first = |index: usize| {
            std::thread::sleep(std::time::Duration::from_millis(if index == 0 { 30 } else { 0 }));
            index * 2
        };
        in_order(
            3,
            700,
            slow_first,
            |_| false,
            |index, result| {
                seen.push((index, result));
                ControlFlow::Continue(())
            },
        );
        assert_eq!(seen, (0..700).map(|index| (index, index * 2)).collect::<Vec<_>>());
    }

    /// How many pieces of work began and how many were handed over.
    fn stopped(is_last: impl Fn(&usize) -> bool + Sync, breaks_at: usize) -> (usize, usize) {
        let begun = AtomicUsize::new(0);
        let mut taken = 0;
        let count = |index| {
            begun.fetch_add(1, Ordering::Relaxed);
            index
        };
        in_order(2, 100_000, count, is_last, |index, _| {
            taken += 1;
            if index == breaks_at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        (begun.into_inner(), taken)
    }

    #[test]
    fn a_last_result_begins_nothing_more_and_nothing_is_lost() {
        let (begun, taken) = stopped(|index| *index == 9, usize::MAX);
        assert_eq!(begun, taken);
        assert!((10..=10 + AHEAD + 2).contains(&begun), "{begun} began");
    }

    #[test]
    fn a_break_begins_nothing_more_and_nothing_is_lost() {
        let (begun, taken) = stopped(|_| false, 9);
        assert_eq!(begun, taken);
        assert!((10..=10 + AHEAD + 2).contains(&begun), "{begun} began");
    }
}
