//! Downloads that have been started.
use crate::GpuFault;
use crate::error::Error;
use std::fmt;
use std::future::Future;
use std::pin::Pin;
use std::task::{Context, Poll};

/// A started download of a device.
pub(crate) trait DeviceDownload<X>:
    Future<Output = Result<X, Error>> + Send + Unpin
{
    /// Waits for the result.
    #[doc(hidden)]
    fn wait(self: Box<Self>) -> Result<X, Error>;
}

/// A download that was started: wait for it, or await it.
#[must_use = "nothing arrives unless waited for"]
pub struct Pending<X>(PendingState<X>);

enum PendingState<X> {
    /// The result; `None` after it was taken.
    Ready(Option<X>),
    Later(Box<dyn DeviceDownload<X>>),
}

impl<X> fmt::Debug for Pending<X> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let is_ready = matches!(self.0, PendingState::Ready(_));
        f.debug_struct("Pending")
            .field("is_here", &is_ready)
            .finish()
    }
}

impl<X> Pending<X> {
    pub(crate) const fn ready(found: X) -> Self {
        Pending(PendingState::Ready(Some(found)))
    }
    #[cfg_attr(
        not(feature = "gpu"),
        expect(dead_code, reason = "only a device is late")
    )]
    pub(crate) fn later(download: impl DeviceDownload<X> + 'static) -> Self {
        Pending(PendingState::Later(Box::new(download)))
    }
    /// Returns the download with `with` applied to its result.
    pub(crate) fn map<Y: 'static>(
        self,
        with: impl Fn(X) -> Y + Send + Unpin + 'static,
    ) -> Pending<Y>
    where
        X: 'static,
    {
        match self.0 {
            PendingState::Ready(found) => Pending(PendingState::Ready(found.map(with))),
            PendingState::Later(download) => {
                Pending(PendingState::Later(Box::new(MappedDownload {
                    download,
                    with,
                })))
            }
        }
    }

    /// Waits for the result.
    ///
    /// # Errors
    ///
    /// [`GpuFault::DeviceLost`], or [`GpuFault::OutOfMemory`] when memory for the result is missing.
    pub fn wait(self) -> Result<X, Error> {
        match self.0 {
            PendingState::Ready(found) => found.ok_or(Error::Gpu(GpuFault::DeviceLost)),
            PendingState::Later(download) => download.wait(),
        }
    }
}

impl<X: Unpin> Future for Pending<X> {
    type Output = Result<X, Error>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        match &mut self.get_mut().0 {
            // A future that is polled after its result was taken stays pending.
            PendingState::Ready(own) => {
                own.take().map_or(Poll::Pending, |own| Poll::Ready(Ok(own)))
            }
            PendingState::Later(own) => Pin::new(&mut **own).poll(context),
        }
    }
}

/// A download with a function to apply to its result.
struct MappedDownload<X, F> {
    download: Box<dyn DeviceDownload<X>>,
    with: F,
}

impl<X, Y, F: Fn(X) -> Y + Send + Unpin> Future for MappedDownload<X, F> {
    type Output = Result<Y, Error>;

    fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        let own = self.get_mut();
        let found = Pin::new(&mut *own.download).poll(context);
        found.map(|found| found.map(&own.with))
    }
}
impl<X, Y, F: Fn(X) -> Y + Send + Unpin> DeviceDownload<Y> for MappedDownload<X, F> {
    fn wait(self: Box<Self>) -> Result<Y, Error> {
        self.download.wait().map(self.with)
    }
}
