//! `catoptric serve`

mod site;

use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, Result, bail, ensure};
use axum::Router;
use tokio::runtime;
use tokio::sync::Notify;

use super::CommandOutcome;
use crate::arguments::ServeArguments;
use crate::console::{print, say};
use crate::interrupt;

/// Where `cargo xtask web` puts the laboratory.
const BUILT: &str = "target/web";
/// The ports to try if none is asked for.
const PORTS: RangeInclusive<u16> = 8080..=8179;

pub(crate) fn run(arguments: &ServeArguments) -> Result<CommandOutcome> {
    let directory = directory(arguments.directory.as_deref())?;
    let listener = listener(arguments.address, arguments.port)?;
    let address = listener.local_addr()?;
    if arguments.port.is_none() && address.port() != *PORTS.start() {
        say(&format!("note: port {} is taken; port {} is used instead", PORTS.start(), address.port()));
    }
    if !address.ip().is_loopback() {
        say(&format!("warning: whoever can reach {address} can read {}", directory.display()));
    }
    let site = site::site(&directory, address.ip().is_loopback())?;
    // Before the address is known to anybody who could then ask for the end.
    let end = Arc::new(Notify::new());
    interrupt::ask_first({
        let end = Arc::clone(&end);
        move || end.notify_one()
    });
    print(&format!("Serving {} at http://{address}/ (Ctrl-C ends it)\n", directory.display()))?;
    if arguments.open {
        open_browser(address);
    }
    serve(listener, site, &end)?;
    Ok(CommandOutcome::Done)
}

/// The directory to serve: the one that is named, or where the laboratory is built.
fn directory(named: Option<&Path>) -> Result<PathBuf> {
    let path = named.unwrap_or(Path::new(BUILT));
    if named.is_none() && !path.exists() {
        bail!(
            "there is no directory {BUILT} here: `cargo xtask web` makes it; or name the directory to serve"
        );
    }
    ensure!(path.exists(), "there is no directory {}", path.display());
    ensure!(path.is_dir(), "{} is not a directory", path.display());
    Ok(path.to_path_buf())
}

/// Listens at the port that is asked for, or at the first one that is free.
fn listener(address: IpAddr, port: Option<u16>) -> Result<TcpListener> {
    for port in port.map_or(PORTS, |port| port..=port) {
        match TcpListener::bind((address, port)) {
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => {}
            other => {
                return other.with_context(|| format!("cannot listen at {}", SocketAddr::new(address, port)));
            }
        }
    }
    match port {
        Some(port) => bail!("port {port} is taken: choose another one with --port, or leave --port out"),
        None => bail!("ports {} to {} are taken: choose another one with --port", PORTS.start(), PORTS.end()),
    }
}

/// Answers requests until `end` is notified.
fn serve(listener: TcpListener, site: Router, end: &Notify) -> Result<()> {
    // Requests are answered by this thread, and files are read by a few others.
    let runtime = runtime::Builder::new_current_thread().max_blocking_threads(4).enable_all().build();
    let runtime = runtime.context("cannot start the server")?;
    let served: io::Result<()> = runtime.block_on(async {
        listener.set_nonblocking(true)?;
        let served = axum::serve(tokio::net::TcpListener::from_std(listener)?, site);
        tokio::select! {
            served = served => served,
            () = end.notified() => Ok(()),
        }
    });
    // Reading from a slow disk is not waited for.
    runtime.shutdown_background();
    served.context("the server failed")
}

/// Opens the page in the user's browser, which outlives the server. The page waits until the server answers.
fn open_browser(address: SocketAddr) {
    // The address that stands for all addresses of a machine is none to connect to.
    let page = match address.ip().is_unspecified() {
        true => format!("http://localhost:{}/", address.port()),
        false => format!("http://{address}/"),
    };
    if let Err(error) = open::that_detached(page) {
        say(&format!("warning: no browser can be opened: {error}"));
    }
}
