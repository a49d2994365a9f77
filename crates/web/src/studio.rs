//! The studio in a worker of the page.

use std::path::Path;
use std::pin::Pin;
use std::time::Duration;

use catoptric_platform::threads::processors;
use catoptric_platform::{files, process};
use catoptric_studio::host::Host as _;
use catoptric_studio::{Command, Language, StartDocument, Studio};
use egui::accesskit::{Node, Rect as NodeRect, TreeUpdate};
use egui::{
    Context, DroppedFile, FullOutput, HoveredFile, Modifiers, OutputCommand, RawInput, Rect, Theme, Vec2,
    ViewportCommand, ViewportId,
};
use js_sys::{Array, Uint8Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

use crate::host::{PERSONS_FOLDER, PageHost};
use crate::page::{PageCommand, PageEvent, StartOptions, css_cursor};
use crate::painter::CanvasPainter;
use crate::picture::ScriptPicture;
use crate::threads;

/// The studio, which draws into a canvas.
#[wasm_bindgen(js_name = Studio)]
pub struct WebStudio {
    context: Context,
    studio: Studio,
    painter: CanvasPainter,
    host: PageHost,
    input: RawInput,
    modifiers: Modifiers,
    /// Of the canvas, CSS pixels.
    size: Vec2,
    /// Pixels of the device in a CSS pixel.
    ratio: f32,
    /// What the page was told last.
    told: Told,
    images: Vec<egui::ColorImage>,
    /// What is seen, as a screen reader is told it, once a script has asked.
    seen: Option<TreeUpdate>,
}

/// A picture that is being drawn for a script of the page.
#[wasm_bindgen(js_name = Picture)]
pub struct WebPicture(ScriptPicture);

/// What the page was told last, so that it is not told again.
#[derive(Debug, Default, PartialEq)]
struct Told {
    cursor: &'static str,
    place: Option<[f32; 2]>,
}

/// What came of a frame.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct FrameReport {
    commands: Vec<PageCommand>,
    /// When the next frame is wanted, milliseconds from now; never unless something happens for `None`.
    delay: Option<f64>,
}

/// How the studio stands.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct StudioState<'a> {
    scene: String,
    title: &'a str,
    is_saved: bool,
    /// Whether a crash would lose nothing.
    is_kept: bool,
    language: Language,
    /// The names of what is selected.
    selected: Vec<&'a str>,
    /// The pixel that is audited: its column and row, and the size of its picture.
    pixel: Option<[[u32; 2]; 2]>,
    /// How many rays it has.
    rays: Option<usize>,
    /// The position and the target of the camera that the picture is seen through.
    view: [[f64; 3]; 2],
    /// The method that draws, as commands call it.
    method: &'static str,
    /// How many pictures there have been.
    pictures: Option<u64>,
    /// Of the picture shown, per pixel.
    samples: Option<u32>,
    /// Whether the picture is finished.
    is_idle: bool,
    /// What drew it: `CPU` or `GPU`.
    backend: &'static str,
    /// The graphics card that can draw it.
    card: Option<&'a str>,
    threads: usize,
    /// Where the picture is, CSS pixels: left, top, width, height.
    viewport: Option<[f32; 4]>,
}

/// Something that is seen in the window.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct SeenWidget {
    role: String,
    name: Option<String>,
    value: Option<String>,
    /// Where it is, CSS pixels: left, top, width, height.
    place: [f64; 4],
}

/// A file that was dropped, which is in the store by now.
#[derive(Debug)]
struct StoredFile(std::path::PathBuf);

impl DroppedFile for StoredFile {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes_async(&self) -> Pin<Box<dyn Future<Output = Result<Vec<u8>, String>> + '_>> {
        Box::pin(std::future::ready(files::read_bytes(&self.0, u64::MAX).map_err(|error| error.to_string())))
    }
}

/// Puts a file into the studio's store: before it starts those of the last time, later those that the person gives.
#[wasm_bindgen(js_name = putFile)]
pub fn put_file(path: &str, bytes: Vec<u8>) -> Result<(), JsError> {
    Ok(files::put(Path::new(path), bytes)?)
}

/// The files that changed since this was asked last: pairs of a path and an array of bytes, or `null` for one that was
/// removed.
#[wasm_bindgen(js_name = takeChanges)]
pub fn take_changes() -> Array {
    let changes = files::take_changes().into_iter().map(|change| {
        let bytes = change.bytes.map_or(JsValue::NULL, |bytes| Uint8Array::from(&*bytes).into());
        Array::of2(&change.path.to_string_lossy().as_ref().into(), &bytes)
    });
    changes.collect()
}

#[wasm_bindgen(js_class = Studio)]
impl WebStudio {
    /// Starts the studio.
    #[wasm_bindgen(constructor)]
    pub fn new(canvas: OffscreenCanvas, options: &str) -> Result<Self, JsError> {
        let options: StartOptions = serde_json::from_str(options)?;
        let painter = CanvasPainter::new(canvas, options.is_whole).map_err(|reason| JsError::new(&reason))?;
        let host = PageHost::new(options.is_embedded);
        threads::tell_of_panics();
        process::use_number(options.page);
        files::create_folders(Path::new(PERSONS_FOLDER))?;
        choose_language(&host, &options.language)?;
        let start = match (options.link, options.example) {
            (Some(view), _) => StartDocument::Link(view),
            (None, Some(name)) => StartDocument::Example(name),
            (None, None) => StartDocument::Last,
        };
        let context = Context::default();
        context.set_request_repaint_callback(|_| threads::wake());
        let mut studio = Studio::new(&context, &start, Box::new(host.clone()))?;
        if options.is_embedded {
            studio.show_picture_alone();
        }
        let input = RawInput { max_texture_side: Some(painter.max_texture_side()), ..RawInput::default() };
        let (size, ratio, told) = (Vec2::new(1.0, 1.0), 1.0, Told::default());
        Ok(Self {
            context,
            studio,
            painter,
            host,
            input,
            modifiers: Modifiers::NONE,
            size,
            ratio,
            told,
            images: Vec::new(),
            seen: None,
        })
    }

    /// Takes note of what happened on the page: a [`PageEvent`].
    pub fn tell(&mut self, event: &str) -> Result<(), JsError> {
        let event: PageEvent = serde_json::from_str(event)?;
        if let Some(modifiers) = event.modifiers()
            && modifiers != self.modifiers
        {
            self.modifiers = modifiers;
            self.input.events.push(egui::Event::ModifiersChanged(modifiers));
        }
        match &event {
            PageEvent::Size { width, height, ratio } => {
                (self.size, self.ratio) = (Vec2::new(*width, *height), *ratio);
            }
            PageEvent::Focus { focused } => self.input.focused = *focused,
            PageEvent::Theme { is_dark } => {
                self.input.system_theme = Some(if *is_dark { Theme::Dark } else { Theme::Light });
            }
            PageEvent::Hovering { count } => self.input.hovered_files = vec![HoveredFile::default(); *count],
            PageEvent::Dropped { paths } => {
                self.input.hovered_files.clear();
                for path in paths {
                    self.input.dropped_files.push(std::sync::Arc::new(StoredFile(path.into())));
                }
            }
            PageEvent::File { id, path } => self.host.answer(*id, path.as_ref().map(Into::into)),
            PageEvent::Run { command } => {
                let known = Command::from_name(command);
                let known = known.ok_or_else(|| JsError::new(&format!("there is no command {command:?}")))?;
                self.studio.run(known.clone());
            }
            PageEvent::Link { outcome } => self.host.link_done((*outcome).into()),
            _ => {}
        }
        self.input.events.extend(event.into_events(self.context.zoom_factor()));
        Ok(())
    }

    /// Lets the graphics card that the page has draw the picture.
    #[wasm_bindgen(js_name = useCard)]
    pub fn use_card(&mut self, name: String, is_software: bool) {
        self.studio.use_page_card(name, is_software);
    }

    /// Draws a frame; `now` in milliseconds.
    pub fn frame(&mut self, now: f64) -> Result<String, JsError> {
        let mut input = self.input.take();
        let zoom = self.context.zoom_factor();
        input.time = Some(now / 1000.0);
        input.screen_rect = Some(Rect::from_min_size(egui::Pos2::ZERO, self.size / zoom));
        let viewport = input.viewports.entry(ViewportId::ROOT).or_default();
        viewport.native_pixels_per_point = Some(self.ratio);
        viewport.inner_rect = input.screen_rect;
        viewport.focused = Some(input.focused);
        let FullOutput { platform_output, textures_delta, shapes, pixels_per_point, mut viewport_output } =
            threads::drawing(|| self.context.run_ui(input, |ui| self.studio.ui(ui)));
        let primitives = self.context.tessellate(shapes, pixels_per_point);
        self.painter
            .resize([self.size.x, self.size.y].map(|side| (side * self.ratio).round().max(1.0) as u32));
        let background = self.context.global_style().visuals.panel_fill.to_normalized_gamma_f32();
        self.painter.paint(primitives, textures_delta, pixels_per_point, background);
        let mut commands = Vec::new();
        self.tell_page(platform_output, zoom, &mut commands);
        let viewport = viewport_output.remove(&ViewportId::ROOT);
        let (delay, wishes) = viewport.map_or((Duration::MAX, Vec::new()), |v| (v.repaint_delay, v.commands));
        commands.extend(wishes.into_iter().filter_map(|wish| match wish {
            ViewportCommand::Title(text) => Some(PageCommand::Title { text }),
            ViewportCommand::RequestPaste => Some(PageCommand::Paste {}),
            _ => None,
        }));
        commands.extend(self.host.take_questions());
        let delay = (delay < Duration::from_secs(3600)).then(|| delay.as_secs_f64() * 1000.0);
        Ok(serde_json::to_string(&FrameReport { commands, delay })?)
    }

    /// How the studio stands, for scripts of the page.
    pub fn state(&mut self) -> Result<String, JsError> {
        let is_kept = self.studio.is_kept();
        let (studio, status) = (&self.studio, self.studio.live().status());
        let (frame, camera) = (studio.live().latest(), studio.view_camera());
        let state = StudioState {
            scene: studio.editor().writing().text(),
            title: studio.editor().title(),
            is_saved: !studio.editor().has_unsaved_work(),
            is_kept,
            language: studio.settings().language,
            selected: studio
                .editor()
                .selection()
                .iter()
                .map(|item| studio.editor().edited().name(item))
                .collect(),
            pixel: studio.audited_pixel(),
            rays: studio.audit_rays(),
            view: [camera.position, camera.target].map(Into::into),
            method: studio.settings().methods.kind().name(),
            pictures: frame.as_ref().map(|frame| frame.picture_serial),
            samples: frame.as_ref().map(|frame| frame.samples),
            is_idle: status.is_idle,
            backend: status.backend,
            card: studio.card_name(),
            threads: processors(),
            viewport: studio
                .viewport_rect()
                .map(|rect| rect * self.context.zoom_factor())
                .map(|rect| [rect.left(), rect.top(), rect.width(), rect.height()]),
        };
        Ok(serde_json::to_string(&state)?)
    }

    /// Starts to draw a picture for a script; the order is JSON.
    #[wasm_bindgen(js_name = drawPicture)]
    pub fn draw_picture(&self, order: &str) -> Result<WebPicture, JsError> {
        Ok(WebPicture(ScriptPicture::start(self.studio.editor().scene(), order)?))
    }

    /// What is seen in the window, as JSON; `undefined` when it is first asked for, until the next frame.
    pub fn widgets(&mut self) -> Result<Option<String>, JsError> {
        self.context.enable_accesskit();
        let zoom = f64::from(self.context.zoom_factor());
        let Some(seen) = &self.seen else { return Ok(None) };
        let name = |node: &Node| {
            let own = node.label().map(str::to_owned);
            own.or_else(|| {
                let label = node.labelled_by().first()?;
                let (_, label) = seen.nodes.iter().find(|(id, _)| id == label)?;
                label.label().or(label.value()).map(str::to_owned)
            })
        };
        let widgets = seen.nodes.iter().filter_map(|(_, node)| {
            let NodeRect { x0, y0, x1, y1 } = node.bounds()?;
            Some(SeenWidget {
                role: format!("{:?}", node.role()),
                name: name(node),
                value: node.value().map(str::to_owned),
                place: [x0, y0, x1 - x0, y1 - y0].map(|length| length * zoom),
            })
        });
        Ok(Some(serde_json::to_string(&widgets.collect::<Vec<_>>())?))
    }

    /// A picture for the clipboard: width, height, and red, green, blue and opacity of every pixel; or `undefined`.
    #[wasm_bindgen(js_name = takeImage)]
    pub fn take_image(&mut self) -> Option<Array> {
        let image = self.images.pop()?;
        let [width, height] = image.size.map(|side| JsValue::from(side as u32));
        let bytes: Vec<u8> = image.pixels.iter().flat_map(egui::Color32::to_srgba_unmultiplied).collect();
        Some(Array::of3(&width, &height, &Uint8Array::from(&bytes[..]).into()))
    }
}

#[wasm_bindgen(js_class = Picture)]
impl WebPicture {
    /// The bytes of its file, once; `undefined` before it is finished.
    pub fn take(&self) -> Result<Option<Uint8Array>, JsError> {
        Ok(self.0.take()?.map(|bytes| Uint8Array::from(&bytes[..])))
    }

    /// How long it was traced, without the start of threads.
    pub fn milliseconds(&self) -> f64 {
        self.0.milliseconds()
    }
}

/// At the first start the language is that of the browser.
fn choose_language(host: &PageHost, locale: &str) -> Result<(), JsError> {
    if let Some(path) = host.settings_path().filter(|path| !files::exists(path)) {
        let settings = serde_json::json!({ "language": Language::of_locale(locale) });
        files::put(&path, settings.to_string().into_bytes())?;
    }
    Ok(())
}

impl WebStudio {
    fn tell_page(&mut self, output: egui::PlatformOutput, zoom: f32, commands: &mut Vec<PageCommand>) {
        self.seen = output.accesskit_update;
        for command in output.commands {
            match command {
                OutputCommand::CopyText(text) => commands.push(PageCommand::Copy { text }),
                OutputCommand::CopyImage(image) => self.images.push(image),
                OutputCommand::OpenUrl(open) => {
                    commands.push(PageCommand::Open { url: open.url, in_new_tab: open.new_tab });
                }
                OutputCommand::TextSelectionSettled(_) => {}
            }
        }
        let css = css_cursor(output.cursor_icon);
        let place = output.ime.map(|ime| ime.cursor_rect.left_bottom() * zoom).map(|at| [at.x, at.y]);
        let told = std::mem::replace(&mut self.told, Told { cursor: css, place });
        if told.cursor != css {
            commands.push(PageCommand::Cursor { css });
        }
        if told.place != place {
            commands.push(PageCommand::TypeAt { place });
        }
    }
}
