//! `catoptric serve`

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::{TcpListener, TcpStream};
use std::process::Child;

use crate::common::{Folder, Ran};
#[cfg(unix)]
use crate::common::{signal, signals_work};

/// A running server, ended when it goes out of scope.
struct Server {
    child: Child,
    /// Host and port.
    host: String,
}

impl Server {
    /// Starts `catoptric serve` and waits until it listens.
    fn start(folder: &Folder, line: &str) -> Self {
        let mut child = folder.command(["serve"].into_iter().chain(line.split_whitespace())).spawn().unwrap();
        let mut said = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut said).unwrap();
        let host = said.split("http://").nth(1).and_then(|rest| rest.split('/').next());
        let Some(host) = host.map(str::to_owned) else {
            child.kill().unwrap();
            panic!("{line}: {said}{:?}", Ran::of(child.wait_with_output().unwrap()));
        };
        assert!(said.starts_with("Serving ") && said.ends_with("(Ctrl-C ends it)\n"), "{said}");
        Self { child, host }
    }

    fn get(&self, path: &str) -> Answer {
        self.ask("GET", path, &format!("Host: {}\r\n", self.host))
    }

    fn ask(&self, method: &str, path: &str, headers: &str) -> Answer {
        let mut stream = TcpStream::connect(&self.host).unwrap();
        write!(stream, "{method} {path} HTTP/1.1\r\n{headers}Connection: close\r\n\r\n").unwrap();
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).unwrap();
        let end = answer.windows(4).position(|bytes| bytes == b"\r\n\r\n").unwrap();
        let head = String::from_utf8(answer[..end].to_vec()).unwrap();
        let status = head.split(' ').nth(1).unwrap().parse().unwrap();
        Answer { status, head: head.to_lowercase(), body: answer[end + 4..].to_vec() }
    }

    /// Ends the server; returns what it said on standard error.
    fn errors(mut self) -> String {
        self.child.kill().unwrap();
        let mut errors = String::new();
        self.child.stderr.as_mut().unwrap().read_to_string(&mut errors).unwrap();
        errors
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[derive(Debug)]
struct Answer {
    status: u16,
    /// The headers in small letters.
    head: String,
    body: Vec<u8>,
}

impl Answer {
    fn has(&self, header: &str) -> bool {
        self.head.lines().any(|line| line == header)
    }

    fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }
}

/// A folder with a folder `web` to serve, and a secret beside it.
fn site() -> Folder {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path("web/single/empty")).unwrap();
    folder.write("secret.txt", "secret");
    folder.write("web/index.html", "<p>front");
    folder.write("web/single/studio.js", "script");
    folder.write("web/single/studio.wasm", "program");
    folder.write("web/single/studio.wasm.gz", "packed");
    folder
}

#[test]
fn files_come_with_the_headers_that_isolate_a_page() {
    let folder = site();
    let server = Server::start(&folder, "web --port 0");
    for (path, content, body) in [
        ("/", "text/html", "<p>front"),
        ("/index.html?a=b", "text/html", "<p>front"),
        ("/single/studio.js", "text/javascript", "script"),
        ("/single/studio.wasm", "application/wasm", "program"),
    ] {
        let answer = server.get(path);
        assert_eq!((answer.status, answer.text().as_str()), (200, body), "{path}");
        for header in [
            &format!("content-type: {content}"),
            "cross-origin-opener-policy: same-origin",
            "cross-origin-embedder-policy: require-corp",
            "cross-origin-resource-policy: same-origin",
            "cache-control: no-cache",
            "x-content-type-options: nosniff",
        ] {
            assert!(answer.has(header), "{path}: {header}: {}", answer.head);
        }
        let policy = answer.head.lines().find(|line| line.starts_with("content-security-policy: "));
        assert_eq!(policy.is_some(), content == "text/html", "{path}");
        assert!(policy.is_none_or(|policy| policy.contains("'wasm-unsafe-eval'")), "{policy:?}");
    }
}

#[test]
fn compressed_copies_and_unchanged_files_save_the_transfer() {
    let folder = site();
    let server = Server::start(&folder, "web --port 0");
    let host = format!("Host: {}\r\n", server.host);
    let packed = server.ask("GET", "/single/studio.wasm", &format!("{host}Accept-Encoding: gzip\r\n"));
    assert_eq!(packed.text(), "packed");
    assert!(
        packed.has("content-encoding: gzip") && packed.has("content-type: application/wasm"),
        "{packed:?}"
    );
    let head = server.ask("HEAD", "/single/studio.js", &host);
    assert_eq!((head.status, head.body.len()), (200, 0));
    assert!(head.has("content-length: 6"), "{}", head.head);
    let tag = head.head.lines().find_map(|line| line.strip_prefix("etag: ")).unwrap();
    let again = server.ask("GET", "/single/studio.js", &format!("{host}If-None-Match: {tag}\r\n"));
    assert_eq!((again.status, again.body.len()), (304, 0));
}

#[test]
fn nothing_outside_is_served() {
    let folder = site();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.path("secret.txt"), folder.path("web/out.txt")).unwrap();
        std::os::unix::fs::symlink(folder.path(""), folder.path("web/out")).unwrap();
        std::os::unix::fs::symlink("single/studio.js", folder.path("web/in.js")).unwrap();
        // Without this command the pipe is not there either.
        let _ = std::process::Command::new("mkfifo").arg(folder.path("web/pipe")).status();
    }
    let server = Server::start(&folder, "web --port 0");
    let secret = folder.path("secret.txt").display().to_string();
    for path in [
        "/../secret.txt",
        "/single/../../secret.txt",
        "/%2e%2e/secret.txt",
        "/..%2fsecret.txt",
        "/%2e%2e%2fsecret.txt",
        "/..%5csecret.txt",
        "/out.txt",
        "/out/secret.txt",
        &secret,
        &format!("/{secret}"),
        &format!("/{}", secret.replace('/', "%2f")),
        "/single/",
        "/single/empty/",
        "/index.html/",
        "/%00",
        "/%ff",
        "/pipe",
        "/no.html",
    ] {
        let answer = server.get(path);
        assert_eq!(answer.status, 404, "{path}: {answer:?}");
        assert!(answer.text().contains("There is no such file here"), "{path}: {answer:?}");
        assert!(!answer.text().contains("secret") && !answer.text().contains("studio"), "{path}: {answer:?}");
    }
    #[cfg(unix)]
    assert_eq!(server.get("/in.js").text(), "script");
}

#[test]
fn other_methods_and_other_hosts_are_refused() {
    let folder = site();
    let server = Server::start(&folder, "web --port 0");
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        let answer = server.ask(method, "/index.html", &format!("Host: {}\r\n", server.host));
        assert_eq!(answer.status, 405, "{method}: {answer:?}");
    }
    let port = server.host.rsplit(':').next().unwrap();
    for (host, status) in [
        (format!("localhost:{port}"), 200),
        (format!("[::1]:{port}"), 200),
        ("127.0.0.1".to_owned(), 200),
        (format!("example.org:{port}"), 421),
        ("localhost.example.org".to_owned(), 421),
        (String::new(), 421),
    ] {
        let answer = server.ask("GET", "/", &format!("Host: {host}\r\n"));
        assert_eq!(answer.status, status, "{host}: {answer:?}");
    }
}

#[test]
fn without_a_name_the_built_laboratory_is_served() {
    let folder = Folder::new();
    assert!(folder.refused("serve").contains("`cargo xtask web` makes it"));
    std::fs::create_dir_all(folder.path("target/web")).unwrap();
    folder.write("target/web/index.html", "built");
    let server = Server::start(&folder, "--port 0");
    assert_eq!(server.get("/").text(), "built");
}

#[test]
fn what_cannot_be_served_is_refused_in_words() {
    let folder = site();
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    for (line, said) in [
        ("serve no", "there is no directory no"),
        ("serve secret.txt", "secret.txt is not a directory"),
        (
            &*format!("serve web --port {port}"),
            &*format!("port {port} is taken: choose another one with --port"),
        ),
        // An address for documents (RFC 5737), which no machine has.
        ("serve web --address 192.0.2.1 --port 0", "cannot listen at 192.0.2.1:0"),
        ("serve web --address localhost", "invalid value 'localhost'"),
        ("serve web --port 65536", "65536"),
    ] {
        let errors = folder.refused(line);
        assert!(errors.contains(said), "{line}: {errors}");
    }
}

#[test]
fn the_next_port_is_used_and_said_if_the_usual_one_is_taken() {
    let folder = site();
    // Where another program has it, it is taken as well.
    let _taken = TcpListener::bind("127.0.0.1:8080");
    let server = Server::start(&folder, "web");
    let port = server.host.strip_prefix("127.0.0.1:").unwrap().to_owned();
    assert!(port.parse::<u16>().unwrap() > 8080, "{port}");
    assert_eq!(server.get("/").status, 200);
    assert_eq!(server.errors(), format!("note: port 8080 is taken; port {port} is used instead\n"));
}

#[cfg(unix)]
#[test]
fn the_usual_end_is_an_interruption() {
    if !signals_work() {
        return;
    }
    let folder = site();
    for name in ["INT", "TERM"] {
        let mut server = Server::start(&folder, "web --port 0");
        // A browser keeps its connection open.
        let _idle = TcpStream::connect(&server.host).unwrap();
        signal(&server.child, name);
        assert_eq!(server.child.wait().unwrap().code(), Some(0), "{name}");
    }
}
