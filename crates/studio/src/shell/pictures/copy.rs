//! Copying pictures to the clipboard.

use std::sync::Arc;

use catoptric_picture::{Development, Picture};
use catoptric_platform::time::{Duration, Instant};
use egui::{ColorImage, Context};

use crate::base::job::{Job, JobStatus};
use crate::base::proof::size_of;
use crate::base::words;
use crate::shell::host::PictureClipboard;
use crate::shell::studio::Studio;
use crate::shell::studio::pictures::{
    CopyFailure, CopyOutcome, CopySource, FinishedPicture, PendingCopy, SavedPlace,
};

/// The most pixels that are copied: a clipboard keeps several copies.
const MOST: usize = 1 << 26;

/// When the person is told that the viewport's picture is still being refined.
const LONG: Duration = Duration::from_secs(1);

/// How long a viewport without any picture is waited for.
const PATIENCE: Duration = Duration::from_secs(10);

/// Copies the viewport's picture as soon as it is refined; asked again meanwhile, as it is.
pub(crate) fn copy_viewport(context: &Context, studio: &mut Studio) {
    let is_hurried = studio.pictures.copying.viewport.is_some();
    studio.pictures.copying.viewport =
        Some(PendingCopy { since: Instant::now(), is_hurried, is_told: is_hurried });
    context.request_repaint();
}

/// Copies a finished picture as it is shown.
pub(super) fn copy_finished(context: &Context, studio: &mut Studio, finished: &FinishedPicture) {
    let (picture, development) = (Arc::clone(&finished.picture), finished.order.development);
    let size = size_of(&picture);
    start(context, studio, CopySource::Finished(finished.number, size), move || {
        codes_of(&picture, development)
    });
}

/// Whether any picture is being copied. Another must wait: the later one is to stay in the clipboard.
pub(super) fn is_any_copying(studio: &Studio) -> bool {
    studio.pictures.copying.job.is_some()
}

/// Whether this picture is being copied.
pub(super) fn is_copying(studio: &Studio, number: u64) -> bool {
    matches!(studio.pictures.copying.job, Some((CopySource::Finished(other, _), _)) if other == number)
}

/// Takes up what has been copied, and copies what has waited for that: once a frame.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    take_copied(context, studio);
    // The window wakes up when the picture before it has been copied.
    if !is_any_copying(studio) {
        look_at_viewport(context, studio);
    }
}

fn take_copied(context: &Context, studio: &mut Studio) {
    let Some((source, job)) = &studio.pictures.copying.job else { return };
    let source = *source;
    let result = match job.poll() {
        JobStatus::Waiting => return,
        JobStatus::Done(result) => result,
        JobStatus::Lost => Err(CopyFailure::Clipboard(String::new())),
    };
    studio.pictures.copying.job = None;
    let failure = match result {
        Ok(copied) => {
            if let CopyOutcome::Image(image) = copied {
                context.copy_image(image);
            }
            return copied_from(studio, source);
        }
        Err(failure) => failure,
    };
    let texts = &studio.texts;
    let told = match failure {
        CopyFailure::TooLarge => texts.get("picture-copy-too-large").to_owned(),
        CopyFailure::Memory => texts.get("picture-copy-memory").to_owned(),
        CopyFailure::Clipboard(reason) => texts.with("picture-copy-failed", &[("reason", reason.into())]),
    };
    studio.toasts.error(told);
}

fn copied_from(studio: &mut Studio, source: CopySource) {
    let (CopySource::Viewport(size) | CopySource::Finished(_, size)) = source;
    if let CopySource::Finished(number, _) = source {
        // A file lasts longer.
        FinishedPicture::with(studio, number, |_, finished| {
            _ = finished.kept.get_or_insert(SavedPlace::Clipboard);
        });
    }
    let size = words::size(size[0], size[1]);
    studio.toasts.success(studio.texts.with("picture-copied", &[("size", size.into())]));
}

fn look_at_viewport(context: &Context, studio: &mut Studio) {
    let Some(mut waiting) = studio.pictures.copying.viewport.take() else { return };
    let (revision, camera) = (studio.editor.revision(), studio.shown_camera());
    let frame = studio
        .live
        .latest()
        .filter(|frame| frame.is_full() && frame.revision == revision && frame.camera == camera);
    let is_refined = |samples| samples >= studio.settings.viewport_samples || studio.view.is_rendering;
    match frame {
        Some(frame) if waiting.is_hurried || is_refined(frame.samples) => {
            let size = frame.picture_size;
            return start(context, studio, CopySource::Viewport(size), move || {
                let pixels = frame.codes().map_err(|error| CopyFailure::Clipboard(error.to_string()))?;
                let mut own = reserved(pixels.len())?;
                own.extend_from_slice(&pixels);
                Ok((size, own))
            });
        }
        None if waiting.since.elapsed() > PATIENCE => {
            studio.toasts.warning(studio.texts.get("picture-copy-none"));
            return;
        }
        Some(_) if waiting.since.elapsed() > LONG && !waiting.is_told => {
            studio.toasts.info(studio.texts.get("picture-copy-waits"));
            waiting.is_told = true;
        }
        _ => {}
    }
    studio.pictures.copying.viewport = Some(waiting);
    context.request_repaint_after(Duration::from_millis(50));
}

/// Copies what `codes` makes, on a thread.
fn start(
    context: &Context,
    studio: &mut Studio,
    source: CopySource,
    codes: impl FnOnce() -> Result<([u32; 2], Vec<u8>), CopyFailure> + Send + 'static,
) {
    let clipboard = studio.host.clipboard();
    let work = move || {
        let (size, codes) = codes()?;
        put(clipboard, size.map(|side| side as usize), &codes)
    };
    match Job::start(context, "copy picture", work) {
        Ok(job) => studio.pictures.copying.job = Some((source, job)),
        Err(error) => {
            studio.toasts.error(words::fault(&studio.texts, &error.to_string()));
        }
    }
}

fn put(
    clipboard: Option<PictureClipboard>,
    size: [usize; 2],
    codes: &[u8],
) -> Result<CopyOutcome, CopyFailure> {
    match clipboard {
        Some(clipboard) => clipboard(size, codes).map(|()| CopyOutcome::Done).map_err(CopyFailure::Clipboard),
        None => Ok(CopyOutcome::Image(ColorImage::from_rgba_unmultiplied(size, codes))),
    }
}

/// Develops a picture: red, green, blue and 255 of every pixel.
fn codes_of(picture: &Picture, development: Development) -> Result<([u32; 2], Vec<u8>), CopyFailure> {
    let count = picture.pixels().len();
    if count > MOST {
        return Err(CopyFailure::TooLarge);
    }
    let mut codes = reserved(4 * count)?;
    codes.resize(4 * count, 0);
    let (pixels, _) = codes.as_chunks_mut::<4>();
    development.develop_rgba8(picture.pixels(), pixels);
    Ok((size_of(picture), codes))
}

fn reserved(bytes: usize) -> Result<Vec<u8>, CopyFailure> {
    let mut room = Vec::new();
    room.try_reserve_exact(bytes).map_err(|_| CopyFailure::Memory)?;
    Ok(room)
}
