use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::io::ErrorKind;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::Path;

/// Who may look, and where: the port, and the token without which nobody is let in.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ticket {
    /// Port on the loopback address; 0: any that is free.
    pub port: u16,
    /// 128 random bits, in hexadecimal digits.
    pub token: String,
}

impl Ticket {
    /// Name of the file in a run's directory, which only its user can read.
    const FILE: &str = "console.json";

    /// A new one.
    pub fn new(port: u16) -> Self {
        let bits: u128 = rand::rng().random();
        Self { port, token: format!("{bits:032x}") }
    }

    /// That of a predecessor in this run, whose pages come back to the same address; none where there was none.
    ///
    /// # Errors
    /// The file cannot be read, or is none.
    pub fn of_predecessor(run: &Path) -> std::io::Result<Option<Self>> {
        match coact_input_file::read_text(&run.join(Self::FILE)) {
            Ok(text) => Ok(Some(serde_json::from_str(&text)?)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Leaves it for a successor.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn leave(&self, run: &Path) -> std::io::Result<()> {
        std::fs::write(run.join(Self::FILE), serde_json::to_vec(self)?)
    }

    /// Where it listens: on the loopback address, and nowhere else.
    pub fn socket(&self) -> SocketAddr {
        (Ipv4Addr::LOCALHOST, self.port).into()
    }

    /// What is to be opened in a browser.
    pub fn address(&self) -> String {
        format!("http://{}/?token={}", self.socket(), self.token)
    }

    /// Whether a browser that shows this `Host`, and this `Origin` if it sends one, means this console: another page that is open in
    /// the same browser says where it comes from.
    pub fn is_meant(&self, host: Option<&str>, origin: Option<&str>) -> bool {
        let own = [format!("127.0.0.1:{}", self.port), format!("localhost:{}", self.port)];
        let is_own = |host: &str| own.iter().any(|own| own == host);
        let is_own_page = |origin: &str| origin.strip_prefix("http://").is_some_and(is_own);
        host.is_some_and(is_own) && origin.is_none_or(is_own_page)
    }

    /// Whether this is the token; how much of it is right takes no time to find out.
    pub fn admits(&self, token: Option<&str>) -> bool {
        let Some(token) = token.filter(|token| token.len() == self.token.len()) else { return false };
        let differing =
            token.bytes().zip(self.token.bytes()).fold(0, |bits, (one, other)| bits | (one ^ other));
        differing == 0
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn only_its_own_pages_with_the_token_are_let_in() {
        let ticket = Ticket::new(7411);
        assert_eq!(ticket.token.len(), 32);
        assert!(ticket.admits(Some(&ticket.token)));
        for wrong in [None, Some(""), Some("0"), Some(Ticket::new(7411).token.as_str())] {
            assert!(!ticket.admits(wrong), "{wrong:?}");
        }
        assert!(ticket.is_meant(Some("127.0.0.1:7411"), None));
        assert!(ticket.is_meant(Some("localhost:7411"), Some("http://localhost:7411")));
        let strangers = [
            (None, None),
            (Some("127.0.0.1"), None),
            (Some("evil.example:7411"), None),
            (Some("127.0.0.1:7411"), Some("http://evil.example")),
            (Some("127.0.0.1:7411"), Some("https://127.0.0.1:7411")),
            (Some("127.0.0.1:7411"), Some("null")),
        ];
        for (host, origin) in strangers {
            assert!(!ticket.is_meant(host, origin), "{host:?} {origin:?}");
        }
    }

    #[test]
    fn a_successor_finds_the_same_address() {
        let run = tempfile::tempdir().unwrap();
        assert_eq!(Ticket::of_predecessor(run.path()).unwrap(), None);
        let ticket = Ticket::new(7411);
        ticket.leave(run.path()).unwrap();
        assert_eq!(Ticket::of_predecessor(run.path()).unwrap(), Some(ticket));
    }
}
