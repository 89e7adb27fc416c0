use crate::EndedWithTest;
use serde_json::{Value, json};
use std::io::{Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;
use tungstenite::{Message, WebSocket};

/// A browser without a window, driven by the DevTools protocol.
#[derive(Debug)]
pub struct Browser {
    _child: EndedWithTest,
    socket: WebSocket<TcpStream>,
    requests: u64,
    /// What went wrong on the page.
    complaints: Vec<String>,
    _profile: tempfile::TempDir,
}

/// Names under which it is installed.
const PROGRAMS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
/// Longest time for anything that is asked of it.
const WITHIN: Duration = Duration::from_secs(60);

impl Browser {
    /// Opens an address in a window of this size, pixels; none where no browser is installed.
    pub fn open(address: &str, [width, height]: [u32; 2]) -> Option<Self> {
        let installed = |program: &&&str| {
            Command::new(program)
                .arg("--version")
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status()
                .is_ok()
        };
        let program = PROGRAMS.iter().find(installed)?;
        let profile = tempfile::tempdir().unwrap();
        let mut command = Command::new(program);
        command.args([
            "--headless=new",
            "--no-sandbox",
            "--disable-dev-shm-usage",
            "--remote-debugging-port=0",
        ]);
        command.args(["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]);
        command.arg(format!("--user-data-dir={}", profile.path().display()));
        command.arg(format!("--window-size={width},{height}")).arg("about:blank");
        command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        let child = EndedWithTest(command.spawn().unwrap());
        let (port, page) = first_page(profile.path());
        let stream = TcpStream::connect(("127.0.0.1", port)).unwrap();
        stream.set_read_timeout(Some(WITHIN)).unwrap();
        let (socket, _) = tungstenite::client(page, stream).unwrap();
        let mut browser =
            Self { _child: child, socket, requests: 0, complaints: Vec::new(), _profile: profile };
        browser.call("Runtime.enable", json!({}));
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        browser.call("Emulation.setDeviceMetricsOverride", size);
        browser.call("Page.navigate", json!({ "url": address }));
        Some(browser)
    }

    /// Has it do something, and gives its answer.
    pub fn call(&mut self, method: &str, parameters: Value) -> Value {
        let request = self.send(method, parameters);
        loop {
            let Message::Text(text) = self.socket.read().unwrap() else { continue };
            let message: Value = serde_json::from_str(&text).unwrap();
            if message["id"] == request {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            if message["method"] == "Runtime.exceptionThrown" {
                self.complaints.push(message["params"]["exceptionDetails"].to_string());
            }
        }
    }

    /// Has it do something whose answer does not matter.
    fn send(&mut self, method: &str, parameters: Value) -> u64 {
        self.requests += 1;
        let message = json!({ "id": self.requests, "method": method, "params": parameters });
        self.socket.send(Message::text(message.to_string())).unwrap();
        self.requests
    }

    /// What an expression is on the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let answer = self.call("Runtime.evaluate", parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {answer}");
        answer["result"]["value"].clone()
    }

    /// Moves the mouse there, or presses or releases its button: `mouseMoved`, `mousePressed`, `mouseReleased`.
    pub fn mouse(&mut self, what: &str, [x, y]: [f64; 2], pressed: bool) {
        let buttons = u32::from(pressed);
        let button = if what == "mouseMoved" && !pressed { "none" } else { "left" };
        let clicks = u32::from(what != "mouseMoved");
        let event = json!({ "type": what, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": clicks });
        self.send("Input.dispatchMouseEvent", event);
    }

    /// Clicks on the element with this id.
    pub fn click(&mut self, id: &str) {
        self.value(&format!("document.getElementById({id:?}).click()"));
    }

    /// Takes colours as somebody has them who prefers dark pages, or light ones.
    pub fn prefer(&mut self, scheme: &str) {
        let features = json!({ "features": [{ "name": "prefers-color-scheme", "value": scheme }] });
        self.call("Emulation.setEmulatedMedia", features);
    }

    /// A picture of the page, PNG, as base64.
    pub fn picture(&mut self) -> String {
        let answer = self.call("Page.captureScreenshot", json!({ "format": "png" }));
        answer["data"].as_str().unwrap().to_owned()
    }

    /// What went wrong on the page so far.
    pub fn complaints(&mut self) -> &[String] {
        self.value("0");
        &self.complaints
    }
}

/// Port and address of the first page, once the browser has one.
fn first_page(profile: &Path) -> (u16, String) {
    let port = crate::wait_within(WITHIN, "the browser", || {
        let told = std::fs::read_to_string(profile.join("DevToolsActivePort")).ok()?;
        told.lines().next()?.parse::<u16>().ok()
    });
    let page = crate::wait_within(WITHIN, "the browser's page", || {
        let mut stream = TcpStream::connect(("127.0.0.1", port)).ok()?;
        stream.write_all(b"GET /json HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n").ok()?;
        let pages = body(&mut stream)?;
        let pages = pages.as_array()?;
        let page = pages.iter().find(|page| page["type"] == "page")?;
        Some(page["webSocketDebuggerUrl"].as_str()?.to_owned())
    });
    (port, page)
}

/// What a server answers, in JSON: it need not close the line when it has said all.
fn body(stream: &mut TcpStream) -> Option<Value> {
    let (mut answer, mut piece) = (Vec::new(), [0; 4096]);
    loop {
        let count = stream.read(&mut piece).ok().filter(|count| *count > 0)?;
        answer.extend_from_slice(&piece[..count]);
        let text = String::from_utf8_lossy(&answer);
        let whole = text.split_once("\r\n\r\n").and_then(|(_, body)| serde_json::from_str(body).ok());
        if whole.is_some() {
            return whole;
        }
    }
}
