//! The console as a process: shows the run in a browser, and passes on what is done there. With `--recording FILE` it is a program of
//! its own, which shows a run that is over.

mod live_console;
mod page_partner;

use anyhow::{Context, bail};
use coact_console::{
    Board, ConsoleSettings, Greeting, LiveTopics, Machine, PictureMaker, RecordedRun, Server, SupervisorLink,
    Ticket, Timeline, Wish,
};
use coact_joint_task::NetworkPlan;
use coact_period::PERIOD_NS;
use coact_pipeline::RunSettings;
use coact_realtime::Process;
use coact_robot::Robot;
use coact_run_records::NextRound;
use coact_safety::SafetyLimits;
use live_console::LiveConsole;
use page_partner::PagePartner;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::time::Duration;

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
    let server = Server { board: run.board(), ticket: Arc::new(ticket.clone()), wishes, supervisor: None };
    invite(&ticket.address(), true);
    let read = move || match run.read() {
        Ok(glimpses) => tracing::info!("all of it is read: {glimpses} glimpses"),
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
    let partner = PagePartner::new(&process, &task, &settings)?;
    process.report_ready()?;
    let Some(schedule) = process.wait_for_start()? else { return Ok(()) };
    let timeline = Timeline::new(&settings.report, &task, &plan, schedule.start_ns);
    let every = Duration::from_secs(1) / own.pictures_per_second;
    let mut console = LiveConsole { topics, maker, timeline, machine, board, partner, schedule, every };
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
    let mut ticket = match Ticket::of_predecessor(folder).context("the address of the console before")? {
        Some(ticket) => ticket,
        None => match NextRound::take(&settings.report).context("the address of the round before")? {
            Some(NextRound { port, token, .. }) => Ticket { port, token },
            None => Ticket::new(own.port),
        },
    };
    let listener = listen(&mut ticket)?;
    ticket.leave(folder).context("the console's address cannot be left for a successor")?;
    let (sender, wishes): (SyncSender<Wish>, _) = sync_channel(WISHES);
    let lets_play = settings.partner == RunSettings::HAND;
    let supervisor = SupervisorLink::new(process.run().clone(), lets_play, ticket.clone());
    let server = Server {
        board: Arc::clone(board),
        ticket: Arc::new(ticket.clone()),
        wishes: sender,
        supervisor: Some(Arc::new(supervisor)),
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

const _: () = assert!(PERIOD_NS == 1_000_000, "a cycle is a millisecond: pages are told cycles as such");
