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

/// Does `work` for `0..count` on `threads` threads and hands the results to `take` one by one in order. When `take`
/// breaks, no further work begins; what had begun is dropped when it is done.
pub fn in_order<R: Send>(
    threads: usize,
    count: usize,
    work: impl Fn(usize) -> R + Sync,
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
    let (send, receive) = channel();
    std::thread::scope(|scope| {
        for _ in 0..threads.min(count) {
            let (send, begin, work) = (send.clone(), &begin, &work);
            scope.spawn(move || {
                while let Some(index) = begin() {
                    if send.send((index, work(index))).is_err() {
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
                let flow = take(wanted, result);
                wanted += 1;
                let mut queue = lock();
                queue.taken = wanted;
                queue.stopped |= flow.is_break();
                changed.notify_all();
                if queue.stopped {
                    return;
                }
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_whatever_takes_longest() {
        let mut seen = Vec::new();
        let slow_first = |index: usize| {
            std::thread::sleep(std::time::Duration::from_millis(if index == 0 { 30 } else { 0 }));
            index * 2
        };
        in_order(3, 700, slow_first, |index, result| {
            seen.push((index, result));
            ControlFlow::Continue(())
        });
        assert_eq!(seen, (0..700).map(|index| (index, index * 2)).collect::<Vec<_>>());
    }

    #[test]
    fn a_break_begins_nothing_more() {
        let begun = std::sync::atomic::AtomicUsize::new(0);
        let count = |index| {
            begun.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            index
        };
        in_order(
            2,
            100_000,
            count,
            |index, _| if index == 9 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) },
        );
        assert!(begun.into_inner() <= 10 + AHEAD + 2);
    }
}
