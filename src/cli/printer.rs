//! Printing in a thread of its own: a reader that is slow holds up the lines, never the work; one that has gone away, or a full
//! disk, ends them.

use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::Duration;

use indicatif::ProgressBar;

use crate::error::clean;

/// Lines are written in pieces of so many bytes, so that a slow reader can be told from one that does not read.
const PIECE: usize = 4096;
/// Lines of so many bytes may wait for their reader [bytes]; more are not printed.
const WAITING: usize = 1 << 24;

/// Something to print.
enum Print {
    /// Text for standard output, or for standard error.
    Out(String),
    Error(String),
    /// A change of the bar.
    Bar(Box<dyn FnOnce(&ProgressBar) + Send>),
}

/// The end at which lines come in; it has copies.
#[derive(Clone)]
pub(super) struct Printer {
    send: Sender<Print>,
    /// Bytes that wait.
    waiting: Arc<AtomicUsize>,
}

/// The thread that prints.
pub(super) struct Printing {
    ended: Receiver<()>,
    /// Pieces that have been written.
    written: Arc<AtomicUsize>,
}

impl Printer {
    /// Starts the thread.
    pub(super) fn start() -> (Printer, Printing) {
        let (send, received) = mpsc::channel::<Print>();
        let (end, ended) = mpsc::channel::<()>();
        let (waiting, written) = (Arc::new(AtomicUsize::new(0)), Arc::new(AtomicUsize::new(0)));
        let mut desk = Desk { bar: None, gone: [false; 2], written: written.clone() };
        let left = waiting.clone();
        std::thread::spawn(move || {
            for print in received {
                let bytes = print.bytes();
                desk.print(print);
                left.fetch_sub(bytes, Ordering::Relaxed);
            }
            desk.bar.iter().for_each(ProgressBar::finish_and_clear);
            drop(end);
        });
        (Printer { send, waiting }, Printing { ended, written })
    }

    /// A line for standard output.
    pub(super) fn out(&self, text: &str) {
        self.send(Print::Out(format!("{}\n", clean(text))));
    }

    /// A line for standard error.
    pub(super) fn error(&self, text: &str) {
        self.send(Print::Error(format!("{}\n", clean(text))));
    }

    /// Text for standard error that is clean and may have colours.
    pub(super) fn coloured_error(&self, text: &str) {
        self.send(Print::Error(format!("{text}\n")));
    }

    /// Changes the bar, which there is from the first change on, on a terminal.
    pub(super) fn bar(&self, change: impl FnOnce(&ProgressBar) + Send + 'static) {
        self.send(Print::Bar(Box::new(change)));
    }

    fn send(&self, print: Print) {
        let bytes = print.bytes();
        if self.waiting.fetch_add(bytes, Ordering::Relaxed) > WAITING {
            self.waiting.fetch_sub(bytes, Ordering::Relaxed);
            return; // nobody reads
        }
        // the thread lives as long as somebody may send
        let _ = self.send.send(print);
    }
}

impl Printing {
    /// Waits until all is printed, but no longer than `patience` without a piece that is read.
    pub(super) fn finish(self, patience: Option<Duration>) {
        loop {
            let before = self.written.load(Ordering::Relaxed);
            match patience {
                None => drop(self.ended.recv()),
                Some(patience) => {
                    if self.ended.recv_timeout(patience) == Err(RecvTimeoutError::Timeout)
                        && self.written.load(Ordering::Relaxed) != before
                    {
                        continue;
                    }
                }
            }
            return;
        }
    }
}

impl Print {
    fn bytes(&self) -> usize {
        match self {
            Print::Out(text) | Print::Error(text) => text.len(),
            Print::Bar(_) => 0,
        }
    }
}

/// The thread's own.
struct Desk {
    bar: Option<ProgressBar>,
    /// True for standard output, and error, if nothing can be printed there any more.
    gone: [bool; 2],
    written: Arc<AtomicUsize>,
}

impl Desk {
    fn print(&mut self, print: Print) {
        match print {
            Print::Out(text) => self.text(0, &text),
            Print::Error(text) => self.text(1, &text),
            Print::Bar(change) => {
                if std::io::stderr().is_terminal() {
                    change(self.bar.get_or_insert_with(ProgressBar::no_length));
                }
            }
        }
    }

    fn text(&mut self, stream: usize, text: &str) {
        if self.gone[stream] {
            return;
        }
        let (written, mut gone) = (&self.written, false);
        let mut write = || {
            gone = text.as_bytes().chunks(PIECE).any(|piece| {
                let done = match stream {
                    0 => std::io::stdout().write_all(piece).and_then(|()| std::io::stdout().flush()),
                    _ => std::io::stderr().write_all(piece),
                };
                written.fetch_add(1, Ordering::Relaxed);
                done.is_err()
            });
        };
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
        self.gone[stream] = gone;
    }
}
