use crate::message_rate::MessageRate;
use crate::{Board, Cadence, Glimpse, Request, SupervisorLink, Wish};
use axum::extract::ws::{Message, WebSocket};
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError};
use std::time::{Duration, Instant};

/// One page that is open.
pub(crate) struct Session {
    pub socket: WebSocket,
    pub board: Arc<Board>,
    pub wishes: SyncSender<Wish>,
    /// Who carries out what an operator asks for; none for a recording.
    pub supervisor: Option<Arc<SupervisorLink>>,
    /// Its number.
    pub page: u64,
}

/// What a page has been told, and what it wants.
#[derive(Debug)]
struct Told {
    role: Option<u64>,
    events: usize,
    machine: u64,
    /// Cycle of the last live picture.
    picture: Option<u64>,
    ended: bool,
    /// It goes through the past, and gets no live pictures.
    looks_back: bool,
    /// Which population it asks about.
    why: Option<usize>,
    explained: Cadence,
    history: Cadence,
}

/// How often an explanation is renewed, and how often it is told how far one can go back.
const EXPLAIN_EVERY: Duration = Duration::from_millis(200);
const HISTORY_EVERY: Duration = Duration::from_secs(1);
/// A page without news is looked after this often.
const LOOK_EVERY: Duration = Duration::from_millis(250);
/// A page that takes nothing in for so long is given up.
const TAKES_WITHIN: Duration = Duration::from_secs(10);

impl Told {
    /// Of a page that has just been opened.
    fn new() -> Self {
        Self {
            role: None,
            events: 0,
            machine: 0,
            picture: None,
            ended: false,
            looks_back: false,
            why: None,
            explained: Cadence::from_now(EXPLAIN_EVERY),
            history: Cadence::from_now(HISTORY_EVERY),
        }
    }
}

impl Session {
    /// Serves the page until it closes, or breaks a rule.
    pub async fn serve(mut self) {
        let mut changed = self.board.subscribe();
        let mut told = Told::new();
        let mut rate = MessageRate::from_now(Instant::now());
        if self.tell(self.board.greeting()).await.is_err() {
            return self.board.leave(self.page);
        }
        loop {
            let heard = tokio::select! {
                _ = changed.changed() => None,
                () = tokio::time::sleep(LOOK_EVERY) => None,
                heard = self.socket.recv() => match heard {
                    Some(Ok(message)) => Some(message),
                    _ => break,
                },
            };
            if let Some(message) = heard {
                if !rate.admits(Instant::now()) {
                    tracing::warn!("page {} is closed: it sends more than any page of ours", self.page);
                    break;
                }
                if self.hear(&message, &mut told).await.is_err() {
                    break;
                }
            } else if self.tell_news(&mut told).await.is_err() {
                break;
            }
        }
        if self.board.plays(self.page) {
            self.wishes.try_send(Wish::Hide).ok();
        }
        self.board.leave(self.page);
    }

    async fn send(&mut self, message: Message) -> Result<(), ()> {
        match tokio::time::timeout(TAKES_WITHIN, self.socket.send(message)).await {
            Ok(Ok(())) => Ok(()),
            _ => Err(()),
        }
    }

    async fn tell(&mut self, what: Value) -> Result<(), ()> {
        self.send(Message::Text(what.to_string().into())).await
    }

    /// All that is new on the board.
    async fn tell_news(&mut self, told: &mut Told) -> Result<(), ()> {
        let (changes, role) = self.board.role(self.page);
        if told.role != Some(changes) {
            told.role = Some(changes);
            self.tell(role).await?;
        }
        if let Some((count, news)) = self.board.events_from(told.events) {
            told.events = count;
            self.tell(news).await?;
        }
        if let Some((version, machine)) = self.board.machine_since(told.machine) {
            told.machine = version;
            self.send(Message::Text(machine.as_ref().into())).await?;
        }
        if told.history.is_due()
            && let Some(history) = self.board.history()
        {
            self.tell(history).await?;
        }
        if let Some(ended) = self.board.ended().filter(|_| !told.ended) {
            told.ended = true;
            self.send(Message::Text(ended.as_ref().into())).await?;
        }
        let Some(now) = self.board.now().filter(|_| !told.looks_back) else { return Ok(()) };
        if told.picture != Some(now.picture.cycle) {
            told.picture = Some(now.picture.cycle);
            self.send(Message::Binary(now.picture.bytes.clone())).await?;
            if told.why.is_some() && told.explained.is_due() {
                self.explain(told.why, &now).await?;
            }
        }
        Ok(())
    }

    async fn explain(&mut self, asked: Option<usize>, glimpse: &Glimpse) -> Result<(), ()> {
        match asked.and_then(|population| self.board.why(population, glimpse)) {
            Some(why) => self.tell(why).await,
            None => Ok(()),
        }
    }

    async fn hear(&mut self, message: &Message, told: &mut Told) -> Result<(), ()> {
        let text = match message {
            Message::Text(text) => text,
            Message::Close(_) | Message::Binary(_) => return Err(()),
            Message::Ping(_) | Message::Pong(_) => return Ok(()),
        };
        let done = match Request::read(text) {
            Ok(request) => self.carry_out(request, told).await?,
            Err(why) => Err(("message", why)),
        };
        match done {
            Ok(()) => Ok(()),
            Err((what, why)) => self.tell(json!({ "kind": "refused", "what": what, "why": why })).await,
        }
    }

    /// Does what a page asks for, or says why not.
    async fn carry_out(
        &mut self,
        request: Request,
        told: &mut Told,
    ) -> Result<Result<(), (&'static str, String)>, ()> {
        match request {
            Request::Why(asked) => {
                told.why = asked;
                let shown = if told.looks_back {
                    told.picture.and_then(|at| self.board.at(at))
                } else {
                    self.board.now()
                };
                if let Some(glimpse) = shown {
                    self.explain(asked, &glimpse).await?;
                }
            }
            Request::At(cycle) => {
                told.looks_back = true;
                if let Some(glimpse) = self.board.at(cycle) {
                    told.picture = Some(glimpse.picture.cycle);
                    self.send(Message::Binary(glimpse.picture.bytes.clone())).await?;
                    self.explain(told.why, &glimpse).await?;
                }
            }
            Request::Live(_) => (told.looks_back, told.picture) = (false, None),
            Request::Play(wanted) => return Ok(self.play(wanted)),
            Request::Pointer(pointer) => return Ok(self.move_hand(Wish::Point(pointer))),
            Request::Hide(_) => return Ok(self.move_hand(Wish::Hide)),
            Request::Say(sentence) => return Ok(self.wish(Wish::Say(sentence.trim().to_owned()), "say")),
            Request::Inject { .. }
            | Request::Stop(_)
            | Request::Resume(_)
            | Request::End(_)
            | Request::Again { .. } => {
                return Ok(self.operate(request).await);
            }
        }
        Ok(Ok(()))
    }

    fn play(&self, wanted: bool) -> Result<(), (&'static str, String)> {
        if !wanted && self.board.plays(self.page) {
            self.wishes.try_send(Wish::Hide).ok();
        }
        let refused = match &self.supervisor {
            None => Some("this run is over"),
            Some(supervisor) if !supervisor.lets_play => {
                Some("this run's partner is a program; coact launch --console")
            }
            Some(_) => None,
        };
        match refused {
            Some(why) if wanted => Err(("play", why.to_owned())),
            _ if self.board.let_play(self.page, wanted) == wanted => Ok(()),
            _ => Err(("play", "somebody else is the partner".to_owned())),
        }
    }

    fn move_hand(&self, wish: Wish) -> Result<(), (&'static str, String)> {
        match self.board.plays(self.page) {
            true => self.wish(wish, "pointer"),
            false => Err(("pointer", "only the partner moves the hand".to_owned())),
        }
    }

    /// What finds no room is passed over: a hand is told of again soon.
    fn wish(&self, wish: Wish, what: &'static str) -> Result<(), (&'static str, String)> {
        if self.supervisor.is_none() {
            return Err((what, "this run is over".to_owned()));
        }
        match self.wishes.try_send(wish) {
            Err(TrySendError::Disconnected(_)) => Err((what, "the run has ended".to_owned())),
            _ => Ok(()),
        }
    }

    async fn operate(&mut self, request: Request) -> Result<(), (&'static str, String)> {
        let Some(supervisor) = self.supervisor.clone() else {
            return Err(("run", "this run is over".to_owned()));
        };
        let what = match request {
            Request::Inject { .. } => "inject",
            Request::Resume(_) => "resume",
            Request::End(_) => "end",
            Request::Again { .. } => "again",
            _ => "stop",
        };
        let done = tokio::task::spawn_blocking(move || supervisor.carry_out(&request)).await;
        done.unwrap_or_else(|_| Err("it failed".to_owned())).map_err(|why| (what, why))
    }
}
