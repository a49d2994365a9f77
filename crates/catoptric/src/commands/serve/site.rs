//! The files of a directory by HTTP, as the laboratory in a browser needs them.

use std::future::Future;
use std::io;
use std::net::IpAddr;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::Arc;

use anyhow::{Context as _, Result};
use axum::Router;
use axum::extract::Request;
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{Next, from_fn, map_response};
use axum::response::{Html, IntoResponse as _, Response};
use tower_http::services::ServeDir;
use tower_http::services::fs::{Backend, TokioBackend};

/// Headers of all answers. The first three isolate the page from others: only then do browsers share memory between its
/// threads (<https://html.spec.whatwg.org/multipage/browsers.html#cross-origin-isolation>). The fourth has a browser ask
/// whether a file it keeps is still the newest.
const HEADERS: [(HeaderName, HeaderValue); 5] = [
    (HeaderName::from_static("cross-origin-opener-policy"), HeaderValue::from_static("same-origin")),
    (HeaderName::from_static("cross-origin-embedder-policy"), HeaderValue::from_static("require-corp")),
    (HeaderName::from_static("cross-origin-resource-policy"), HeaderValue::from_static("same-origin")),
    (header::CACHE_CONTROL, HeaderValue::from_static("no-cache")),
    (header::X_CONTENT_TYPE_OPTIONS, HeaderValue::from_static("nosniff")),
];

/// What a page may load: files of this server, WebAssembly among them, and pictures that it makes itself.
const PAGE_POLICY: HeaderValue = HeaderValue::from_static(
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; object-src 'none'; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
);

const NOT_FOUND: &str = "<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n\
    <meta name=\"viewport\" content=\"width=device-width\">\n<title>Not found</title>\n<h1>Not found</h1>\n\
    <p>There is no such file here. <a href=\"/\">To the first page</a></p>\n</html>\n";

const WRONG_HOST: &str = "This server answers on this machine only, at localhost or 127.0.0.1.\n";

/// Answers requests for the files of `directory`, also from their compressed copies (`.gz`). If `is_local`, it refuses
/// requests that call the server by another name than this machine's own.
///
/// # Errors
/// When the directory cannot be found any more.
pub(super) fn site(directory: &Path, is_local: bool) -> Result<Router> {
    let root = directory.canonicalize().with_context(|| directory.display().to_string())?;
    let files = EnclosedFiles { root: root.as_path().into() };
    let mut site = Router::new()
        .fallback_service(ServeDir::with_backend(root, files).precompressed_br().precompressed_gzip());
    if is_local {
        site = site.layer(from_fn(refuse_other_names));
    }
    Ok(site.layer(map_response(complete)))
}

/// Refuses requests for other hosts: a page from elsewhere, whose name has come to mean this machine (DNS rebinding),
/// could read the files otherwise.
async fn refuse_other_names(request: Request, next: Next) -> Response {
    let host = request.headers().get(header::HOST).and_then(|host| host.to_str().ok());
    match host.is_some_and(is_own_name) {
        true => next.run(request).await,
        false => (StatusCode::MISDIRECTED_REQUEST, WRONG_HOST).into_response(),
    }
}

/// Whether a host, perhaps with a port, is an address or `localhost`.
fn is_own_name(host: &str) -> bool {
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|digit| digit.is_ascii_digit()) => name,
        _ => host,
    };
    name.eq_ignore_ascii_case("localhost") || name.trim_matches(['[', ']']).parse::<IpAddr>().is_ok()
}

/// Adds what all answers have in common.
async fn complete(response: Response) -> Response {
    let mut response = match response.status() {
        StatusCode::NOT_FOUND => (StatusCode::NOT_FOUND, Html(NOT_FOUND)).into_response(),
        _ => response,
    };
    let headers = response.headers_mut();
    headers.extend(HEADERS);
    let content = headers.get(header::CONTENT_TYPE);
    if content.is_some_and(|content| content.as_bytes().starts_with(b"text/html")) {
        headers.insert(header::CONTENT_SECURITY_POLICY, PAGE_POLICY);
    }
    response
}

/// The files below a directory. Those to which a symbolic link leads out of it do not exist.
#[derive(Clone, Debug)]
struct EnclosedFiles {
    root: Arc<Path>,
}

impl EnclosedFiles {
    /// The true path of the file at `path`.
    async fn enclosed(&self, path: &Path) -> io::Result<PathBuf> {
        let path = tokio::fs::canonicalize(path).await?;
        if path.starts_with(&self.root) { Ok(path) } else { Err(io::ErrorKind::NotFound.into()) }
    }
}

impl Backend for EnclosedFiles {
    type File = <TokioBackend as Backend>::File;
    type Metadata = <TokioBackend as Backend>::Metadata;
    type OpenFuture = Pin<Box<dyn Future<Output = io::Result<Self::File>> + Send>>;
    type MetadataFuture = Pin<Box<dyn Future<Output = io::Result<Self::Metadata>> + Send>>;

    fn open(&self, path: PathBuf) -> Self::OpenFuture {
        let files = self.clone();
        Box::pin(async move {
            let path = files.enclosed(&path).await?;
            // Opening a pipe would wait for its writer.
            match tokio::fs::metadata(&path).await?.is_file() {
                true => TokioBackend.open(path).await,
                false => Err(io::ErrorKind::NotFound.into()),
            }
        })
    }

    fn metadata(&self, path: PathBuf) -> Self::MetadataFuture {
        let files = self.clone();
        Box::pin(async move { TokioBackend.metadata(files.enclosed(&path).await?).await })
    }
}
