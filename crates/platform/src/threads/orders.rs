//! Orders to a task.

use std::collections::VecDeque;
use std::future::poll_fn;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll, Waker};

/// Orders to a task that was started by [`start_task`](super::start_task), first come, first served.
#[derive(Debug)]
pub struct Orders<T> {
    state: Mutex<OrdersState<T>>,
    /// Rings for a task that has a thread of its own.
    bell: Condvar,
}

#[derive(Debug)]
struct OrdersState<T> {
    open: VecDeque<T>,
    is_closed: bool,
    /// Of a task between whose turns its thread does other work.
    waker: Option<Waker>,
}

impl<T> Default for Orders<T> {
    fn default() -> Self {
        let state = OrdersState { open: VecDeque::new(), is_closed: false, waker: None };
        Self { state: Mutex::new(state), bell: Condvar::new() }
    }
}

impl<T> Orders<T> {
    /// Gives the task another order.
    pub fn send(&self, order: T) {
        self.change(|state| state.open.push_back(order));
    }

    /// Lets the task end, whatever is still open.
    pub fn close(&self) {
        self.change(|state| {
            state.is_closed = true;
            state.open.clear();
        });
    }

    /// The next order, for the one task that they are meant for; `None` when it is to end. A thread of its own sleeps
    /// meanwhile.
    pub async fn next(&self) -> Option<T> {
        poll_fn(|context| self.poll(context)).await
    }

    fn poll(&self, context: &Context<'_>) -> Poll<Option<T>> {
        let mut state = self.lock();
        loop {
            if state.is_closed {
                return Poll::Ready(None);
            }
            if let Some(order) = state.open.pop_front() {
                return Poll::Ready(Some(order));
            }
            if cfg!(target_family = "wasm") {
                state.waker = Some(context.waker().clone());
                return Poll::Pending;
            }
            state = self.bell.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn change(&self, change: impl FnOnce(&mut OrdersState<T>)) {
        let mut state = self.lock();
        change(&mut state);
        let waker = state.waker.take();
        drop(state);
        self.bell.notify_one();
        if let Some(waker) = waker {
            waker.wake();
        }
    }

    fn lock(&self) -> MutexGuard<'_, OrdersState<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::sync::mpsc::channel;

    use super::*;
    use crate::threads::start_task;

    #[test]
    fn a_task_does_its_orders_in_turn_and_ends() {
        let orders = Arc::new(Orders::default());
        let (sender, receiver) = channel();
        orders.send(1);
        let given = Arc::clone(&orders);
        start_task("test", move || async move {
            while let Some(order) = given.next().await {
                sender.send(order).unwrap();
            }
        })
        .unwrap();
        orders.send(2);
        assert_eq!((receiver.recv(), receiver.recv()), (Ok(1), Ok(2)));
        orders.close();
        assert!(receiver.recv().is_err(), "the task and its end of the channel are gone");
    }
}
