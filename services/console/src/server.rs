use crate::session::Session;
use crate::{Board, SupervisorLink, Ticket, Wish, assets};
use axum::Router;
use axum::body::Body;
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{Query, Request, State};
use axum::http::{HeaderMap, StatusCode, Uri, header};
use axum::middleware::{Next, from_fn_with_state};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use serde::Deserialize;
use std::net::TcpListener;
use std::sync::Arc;
use std::sync::mpsc::SyncSender;

/// Serves pages on the loopback address, and nowhere else.
#[derive(Debug, Clone)]
pub struct Server {
    /// What is shown.
    pub board: Arc<Board>,
    /// Who may look.
    pub ticket: Arc<Ticket>,
    /// Where the wishes of the partner go.
    pub wishes: SyncSender<Wish>,
    /// Who carries out what operators ask for; none for a recording.
    pub supervisor: Option<Arc<SupervisorLink>>,
}

/// Longest message of a page, bytes: a sentence, and room.
const LONGEST_MESSAGE: usize = 4096;

/// A page may load nothing from anywhere else, and may be shown in no other page.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; \
                      base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

#[derive(Debug, Deserialize)]
struct Admission {
    token: Option<String>,
}

impl Server {
    /// Serves until the process ends.
    ///
    /// # Errors
    /// The system does not let it.
    pub fn run(self, listener: TcpListener) -> std::io::Result<()> {
        listener.set_nonblocking(true)?;
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build()?;
        let router = Router::new()
            .route("/live", get(live))
            .fallback(page)
            .layer(from_fn_with_state(self.clone(), only_own))
            .with_state(self);
        runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(listener)?;
            axum::serve(listener, router).await
        })
    }
}

/// Refuses what another page in the same browser, or another name of this machine, asks for.
async fn only_own(State(server): State<Server>, request: Request, next: Next) -> Response {
    let is_meant = {
        let header = |name| request.headers().get(name).and_then(|value| value.to_str().ok());
        server.ticket.is_meant(header(header::HOST), header(header::ORIGIN))
    };
    if !is_meant {
        return (StatusCode::FORBIDDEN, "not from here").into_response();
    }
    next.run(request).await
}

async fn page(uri: Uri) -> Response {
    let Some((bytes, kind)) = assets::find(uri.path()) else {
        return (StatusCode::NOT_FOUND, "there is no such file").into_response();
    };
    let mut response = Response::new(Body::from(bytes));
    for (name, value) in [
        (header::CONTENT_TYPE, kind),
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CONTENT_SECURITY_POLICY, POLICY),
    ] {
        response.headers_mut().insert(name, axum::http::HeaderValue::from_static(value));
    }
    response
}

async fn live(
    State(server): State<Server>,
    Query(admission): Query<Admission>,
    headers: HeaderMap,
    upgrade: WebSocketUpgrade,
) -> Response {
    // A browser always says where a socket comes from.
    if !headers.contains_key(header::ORIGIN) || !server.ticket.admits(admission.token.as_deref()) {
        return (StatusCode::FORBIDDEN, "the token is not right").into_response();
    }
    let upgrade = upgrade.max_message_size(LONGEST_MESSAGE).max_frame_size(LONGEST_MESSAGE);
    upgrade.on_upgrade(move |socket| {
        let Server { board, wishes, supervisor, .. } = server;
        let page = board.enter();
        Session { socket, board, wishes, supervisor, page }.serve()
    })
}
