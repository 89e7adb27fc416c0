use crate::{ConsoleSettings, Glimpse, History};
use coact_fields::Explanation;
use coact_joint_task::NetworkPlan;
use serde_json::{Value, json};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::watch;

/// What is shown, for all pages: one side puts up what it has, each page takes what is new to it when it has time.
///
/// A page that is slow only sees fewer pictures; nothing waits for it, and nothing is kept for it.
#[derive(Debug)]
pub struct Board {
    shown: Mutex<Shown>,
    changed: watch::Sender<()>,
    plan: NetworkPlan,
}

#[derive(Debug)]
struct Shown {
    greeting: Value,
    now: Option<Arc<Glimpse>>,
    history: History,
    events: Vec<Value>,
    /// What is told of the machine, and how often it has changed.
    machine: (u64, Option<Arc<str>>),
    ended: Option<Arc<str>>,
    /// The page that is the partner, and how often that has changed.
    player: (u64, Option<u64>),
    pages: u64,
}

impl Board {
    /// An empty one for a run that is greeted so.
    pub fn new(settings: &ConsoleSettings, greeting: Value, plan: NetworkPlan) -> Self {
        let shown = Shown {
            greeting,
            now: None,
            history: History::new(settings.pictures_kept),
            events: Vec::new(),
            machine: (0, None),
            ended: None,
            player: (0, None),
            pages: 0,
        };
        Self { shown: Mutex::new(shown), changed: watch::Sender::new(()), plan }
    }

    fn shown(&self) -> MutexGuard<'_, Shown> {
        // A page that panicked has at most left its own role behind.
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes who waits for news.
    pub fn subscribe(&self) -> watch::Receiver<()> {
        self.changed.subscribe()
    }

    /// Puts up what is seen now.
    pub fn put_glimpse(&self, glimpse: Glimpse) {
        let mut shown = self.shown();
        shown.history.keep(&glimpse);
        shown.now = Some(Arc::new(glimpse));
        drop(shown);
        self.changed.send_replace(());
    }

    /// Puts up what has happened since the last call: `events` are all so far.
    pub fn put_events(&self, events: &[Value]) {
        let mut shown = self.shown();
        let known = shown.events.len();
        shown.events.extend_from_slice(&events[known.min(events.len())..]);
    }

    /// Puts up how punctual the processes are.
    pub fn put_machine(&self, machine: &Value) {
        let mut shown = self.shown();
        shown.machine = (shown.machine.0 + 1, Some(machine.to_string().into()));
    }

    /// Puts up how the run has ended.
    pub fn put_end(&self, ended: &Value) {
        self.shown().ended = Some(ended.to_string().into());
        self.changed.send_replace(());
    }

    /// A page has opened: its number.
    pub fn enter(&self) -> u64 {
        let mut shown = self.shown();
        shown.pages += 1;
        shown.pages
    }

    /// A page has closed.
    pub fn leave(&self, page: u64) {
        self.let_play(page, false);
    }

    /// A page wants to be the partner, or no longer: whether it is now. Who comes first stays until he leaves.
    pub fn let_play(&self, page: u64, wanted: bool) -> bool {
        let mut shown = self.shown();
        let (changes, player) = shown.player;
        match player {
            Some(player) if player == page && !wanted => shown.player = (changes + 1, None),
            None if wanted => shown.player = (changes + 1, Some(page)),
            _ => (),
        }
        shown.player.1 == Some(page)
    }

    /// Whether a page is the partner.
    pub fn plays(&self, page: u64) -> bool {
        self.shown().player.1 == Some(page)
    }

    /// Who is the partner: how often that has changed, and what a page is told of it.
    pub fn role(&self, page: u64) -> (u64, Value) {
        let (changes, player) = self.shown().player;
        let role = if player == Some(page) { "player" } else { "watcher" };
        (changes, json!({ "kind": "role", "role": role, "players": u32::from(player.is_some()) }))
    }

    /// What a page is told first.
    pub fn greeting(&self) -> Value {
        let mut greeting = self.shown().greeting.clone();
        greeting["role"] = "watcher".into();
        greeting
    }

    /// What is seen now.
    pub fn now(&self) -> Option<Arc<Glimpse>> {
        self.shown().now.clone()
    }

    /// The glimpse of the past that is nearest to `cycle`.
    pub fn at(&self, cycle: u64) -> Option<Arc<Glimpse>> {
        self.shown().history.at(cycle).cloned()
    }

    /// The events from that number on, as a page is told them; none when there are none.
    pub fn events_from(&self, first: usize) -> Option<(usize, Value)> {
        let shown = self.shown();
        let news = shown.events.get(first..).filter(|news| !news.is_empty())?;
        Some((shown.events.len(), json!({ "kind": "events", "first": first, "events": news })))
    }

    /// What is told of the machine, if it has changed since.
    pub fn machine_since(&self, version: u64) -> Option<(u64, Arc<str>)> {
        let (current, machine) = self.shown().machine.clone();
        machine.filter(|_| current != version).map(|machine| (current, machine))
    }

    /// How far a page can go back, as it is told.
    pub fn history(&self) -> Option<Value> {
        let (first, last) = self.shown().history.range()?;
        Some(json!({ "kind": "history", "first_ms": first, "last_ms": last }))
    }

    /// How the run has ended, once it has.
    pub fn ended(&self) -> Option<Arc<str>> {
        self.shown().ended.clone()
    }

    /// Why a population stood or did not at a glimpse; none where there is no such population.
    pub fn why(&self, population: usize, glimpse: &Glimpse) -> Option<Value> {
        let since = *glimpse.since.get(population)?;
        let signals: Vec<f64> = glimpse.signals.iter().map(|signal| f64::from(*signal)).collect();
        let explained = Explanation::of_signals(&self.plan, population, &signals, since);
        Some(crate::why::to_json(&self.plan, &explained, glimpse.picture.cycle))
    }
}
