//! The console as a process: shows the run in a browser, and passes on what is done there. With `--recording FILE` it is a program of
//! its own, which shows a run that is over.

use anyhow::{Context, bail};
use coact_console::{
    Board, ConsoleSettings, Greeting, LiveTopics, Machine, Operator, PictureMaker, PointerHand, RecordedRun,
    Seen, Server, Surroundings, Ticket, Timeline, Wish, report,
};
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{HandPoints, Speech, topic};
use coact_period::PERIOD_NS;
use coact_pipeline::RunSettings;
use coact_realtime::{Output, PortError, Process, Schedule, now};
use coact_robot::Robot;
use coact_run_records::Summary;
use coact_safety::SafetyLimits;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::{Duration, Instant};

/// How often the run is looked at: often enough for all pulses, and for a hand that is to be passed on at once.
const LOOK_EVERY: Duration = Duration::from_millis(4);
/// From one frame of the partner's hand to the next: a camera's 60 Hz.
const FRAME: Duration = Duration::from_nanos(16_666_667);
/// A page that has not told of its pointer for so long is gone, and nobody sees the hand any more.
const POINTED_WITHIN: Duration = Duration::from_millis(250);
/// How often it is looked into the logs, and what the machine does is told anew.
const READ_EVERY: Duration = Duration::from_millis(200);
const TELL_EVERY: Duration = Duration::from_secs(1);
/// How long the console waits for the monitor's summary at the end: less than the process table gives it.
const SUMMARY_WITHIN: Duration = Duration::from_millis(4500);
/// How long pages have then to take in how it ended.
const FAREWELL: Duration = Duration::from_millis(300);
/// Wishes that may wait.
const WISHES: usize = 64;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    match &arguments[..] {
        [option, file, settings] if option == "--recording" => {
            show_recording(file.as_ref(), settings.as_ref())
        }
        _ => follow_run(),
    }
}

/// Shows a recording until Ctrl-C.
fn show_recording(file: &Path, settings: &Path) -> anyhow::Result<()> {
    tracing_subscriber::fmt().without_time().with_target(false).with_writer(std::io::stderr).init();
    let settings = ConsoleSettings::load(settings)?;
    let run = RecordedRun::open(file, &settings)?;
    let mut ticket = Ticket::new(settings.port);
    let listener = listen(&mut ticket)?;
    let (wishes, _none) = sync_channel(1);
    let server = Server { board: run.board(), ticket: Arc::new(ticket.clone()), wishes, operator: None };
    invite(&ticket.address(), true);
    let read = move || match run.read() {
        Ok(moments) => tracing::info!("all of it is read: {moments} moments"),
        Err(error) => tracing::error!("{error}; what was read up to there is shown"),
    };
    std::thread::Builder::new().name("reader".to_owned()).spawn(read).context("no thread to read with")?;
    server.run(listener).context("the server ended")
}

fn follow_run() -> anyhow::Result<()> {
    let mut process = Process::from_arguments("console")?;
    let settings = process.run().settings().clone();
    let folder = settings.pipeline.parent().context("the process table stands in no folder")?;
    let own = ConsoleSettings::load(&folder.join(ConsoleSettings::FILE))?;
    let (task, plan) = NetworkPlan::load(&settings.task)?;
    let safety = SafetyLimits::load(&settings.safety)?;
    let maker = PictureMaker::new(task.clone(), plan.clone(), Robot::load(&settings.robot)?, &safety.person)?;
    let greeting = Greeting {
        run: process.run().id(),
        settings: &settings,
        pipeline: process.pipeline(),
        maker: &maker,
        recorded: false,
    };
    let board = Arc::new(Board::new(&own, greeting.to_json(), plan.clone()));
    let topics = LiveTopics::open(process.bus(), process.pipeline())?;
    let machine = Machine::new(process.pipeline(), safety.stale.input_after);
    let wishes = serve(&process, &own, &settings, &board)?;
    let partner = Partner::new(&process, &task, &settings)?;
    process.report_ready()?;
    let Some(schedule) = process.wait_for_start()? else { return Ok(()) };
    let timeline = Timeline::new(&settings.report, &task, &plan, schedule.start_ns);
    let every = Duration::from_secs(1) / own.pictures_per_second;
    let mut console = Console { topics, maker, timeline, machine, board, partner, schedule, every };
    console.follow(&mut process, &wishes)?;
    console.say_how_it_ended(&settings.report)
}

/// Begins to serve pages: on the address of a predecessor in this run, if there was one.
fn serve(
    process: &Process,
    own: &ConsoleSettings,
    settings: &RunSettings,
    board: &Arc<Board>,
) -> anyhow::Result<Receiver<Wish>> {
    let folder = process.run().directory();
    let predecessor = Ticket::of_predecessor(folder).context("the address of the console before")?;
    let mut ticket = predecessor.unwrap_or_else(|| Ticket::new(own.port));
    let listener = listen(&mut ticket)?;
    ticket.leave(folder).context("the console's address cannot be left for a successor")?;
    let (sender, wishes): (SyncSender<Wish>, _) = sync_channel(WISHES);
    let lets_play = settings.partner == "hand";
    let operator = Operator::new(process.run().clone(), lets_play);
    let server = Server {
        board: Arc::clone(board),
        ticket: Arc::new(ticket.clone()),
        wishes: sender,
        operator: Some(Arc::new(operator)),
    };
    process.spawn_background("server", move || {
        if let Err(error) = server.run(listener) {
            tracing::error!("nobody is served any more: {error}");
        }
    })?;
    invite(&ticket.address(), process.generation() == 0);
    Ok(wishes)
}

/// Says where the console is, whatever is logged, and where there is a screen and `wanted`, opens it.
fn invite(address: &str, wanted: bool) {
    eprintln!("open {address}");
    let has_screen = ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| std::env::var_os(name).is_some());
    if wanted && has_screen {
        // Where nothing can open it, the line above is there.
        Command::new("xdg-open").arg(address).stdout(Stdio::null()).stderr(Stdio::null()).spawn().ok();
    }
}

/// Listens where the ticket says; the ticket then says which port that is.
fn listen(ticket: &mut Ticket) -> anyhow::Result<TcpListener> {
    let listener = TcpListener::bind(ticket.socket()).with_context(|| {
        format!(
            "{}: expected a free port; choose another one in rt-config/console.toml, or 0",
            ticket.socket()
        )
    })?;
    ticket.port = listener.local_addr()?.port();
    if ticket.port == 0 {
        bail!("the system gives no port");
    }
    Ok(listener)
}

/// What is shown of a run, and done in it.
struct Console {
    topics: LiveTopics,
    maker: PictureMaker,
    timeline: Timeline,
    machine: Machine,
    board: Arc<Board>,
    partner: Partner,
    schedule: Schedule,
    /// From one picture to the next.
    every: Duration,
}

impl Console {
    /// Follows the run until it ends.
    fn follow(&mut self, process: &mut Process, wishes: &Receiver<Wish>) -> anyhow::Result<()> {
        let mut heartbeat = process.heartbeat()?;
        let (mut picture, mut read, mut told) = (Instant::now(), Instant::now(), Instant::now());
        while !process.stop_requested() {
            heartbeat.beat()?;
            self.topics.refresh(&mut self.machine)?;
            let seen = self.topics.seen();
            self.timeline.watch(&seen);
            let cycle = self.schedule.tick_at(now());
            if let Ok(wish) = wishes.recv_timeout(LOOK_EVERY) {
                self.partner.take(wish, cycle)?;
                wishes.try_iter().try_for_each(|wish| self.partner.take(wish, cycle))?;
            }
            self.partner.show_hand(self.maker.task(), &seen, cycle)?;
            if picture.elapsed() >= self.every {
                picture = next(picture, self.every);
                if let Some(moment) = self.maker.moment(&seen) {
                    self.board.put_moment(moment);
                }
            }
            if read.elapsed() >= READ_EVERY {
                read = Instant::now();
                self.timeline.read_logs()?;
                self.board.put_events(self.timeline.events());
            }
            if told.elapsed() >= TELL_EVERY {
                told = Instant::now();
                self.board.put_machine(&self.machine.to_json(cycle));
            }
            process.warn_of_refusals();
        }
        Ok(())
    }

    /// Tells all pages how the run has ended, once the monitor has said so.
    fn say_how_it_ended(&mut self, folder: &Path) -> anyhow::Result<()> {
        let begin = Instant::now();
        while !folder.join(Summary::FILE).is_file() && begin.elapsed() < SUMMARY_WITHIN {
            std::thread::sleep(LOOK_EVERY);
        }
        // A log that cannot be read must not hide how it ended.
        if let Err(error) = self.timeline.read_logs() {
            tracing::warn!("{error}");
        }
        self.board.put_events(self.timeline.events());
        let cycle = self.topics.seen().cycle().unwrap_or_default();
        let errors = self.timeline.events().iter().filter(|event| event["sort"] == "error").count();
        self.board.put_end(&report(folder, cycle, errors));
        std::thread::sleep(FAREWELL);
        Ok(())
    }
}

/// When the next picture is due: what is late is not caught up with.
fn next(due: Instant, every: Duration) -> Instant {
    let next = due + every;
    if next.elapsed() >= every { Instant::now() } else { next }
}

/// The person at a page: a hand and a voice.
struct Partner {
    hand: PointerHand,
    around: Surroundings,
    pointed: Option<(coact_console::Pointer, Instant)>,
    frame: Instant,
    hands: Option<Output<HandPoints>>,
    speech: Output<Speech>,
}

impl Partner {
    fn new(process: &Process, task: &Task, settings: &RunSettings) -> Result<Self, PortError> {
        let bus = process.bus();
        let hands = (settings.partner == "hand").then(|| bus.output(topic::HAND)).transpose()?;
        let speech = bus.output(topic::HEARD)?;
        let (hand, around) = (PointerHand::new(task), Surroundings::default());
        Ok(Self { hand, around, pointed: None, frame: Instant::now(), hands, speech })
    }

    fn take(&mut self, wish: Wish, cycle: u64) -> Result<(), PortError> {
        match wish {
            Wish::Point(pointer) => self.pointed = Some((pointer, Instant::now())),
            Wish::Hide => self.pointed = None,
            Wish::Say(sentence) => {
                let mut message = self.speech.loan()?;
                message.write(&sentence);
                message.send(cycle, now())?;
            }
        }
        Ok(())
    }

    /// Shows the hand to the tracker, when a frame is due and somebody points.
    fn show_hand(&mut self, task: &Task, seen: &Seen, cycle: u64) -> Result<(), PortError> {
        let Some(hands) = &mut self.hands else { return Ok(()) };
        let Some((pointer, _)) = self.pointed.filter(|(_, when)| when.elapsed() < POINTED_WITHIN) else {
            return Ok(());
        };
        let elapsed = self.frame.elapsed();
        if elapsed < FRAME {
            return Ok(());
        }
        self.frame = next(self.frame, FRAME);
        let step = elapsed.min(2 * FRAME).as_secs_f64();
        self.around.look(task, seen);
        let points = self.hand.step(&pointer, &self.around, step);
        let mut message = hands.loan()?;
        message.position = points.map(|point| point.to_array());
        message.send(cycle, now())?;
        Ok(())
    }
}

const _: () = assert!(PERIOD_NS == 1_000_000, "a cycle is a millisecond: pages are told cycles as such");
