use crate::{Figure, FigureError, Index, RunTrace, Scenario};
use coact_drawing::Lettering;
use std::path::Path;

/// Which figures are wanted, and where.
#[derive(Debug, Clone)]
pub struct Gallery<'a> {
    /// Folder `rt-config`.
    pub configuration: &'a Path,
    /// The folder that takes the pictures; it is made if it is not there.
    pub out: &'a Path,
    /// The figures.
    pub figures: Vec<Figure>,
    /// Seed of the runs.
    pub seed: u64,
}

/// How far it has come.
#[derive(Debug, Clone, Copy)]
pub enum Step {
    /// A run, and its time, ms.
    Run(Scenario, u64),
    /// A figure is drawn.
    Figure(u32),
}

impl Gallery<'_> {
    /// Runs what the figures show, draws them, and writes `figure-NN.svg`, `figure-NN.png` and `figures.json`.
    ///
    /// # Errors
    /// A file that a stage refuses, or a folder that cannot be written to.
    pub fn draw(&self, progress: &mut dyn FnMut(Step)) -> Result<Index, FigureError> {
        std::fs::create_dir_all(self.out)
            .map_err(|cause| FigureError::Folder { path: self.out.to_owned(), cause })?;
        let letters = Lettering::new()?;
        let traces = self.record(progress)?;
        let mut index = Index::new(self.seed);
        for figure in &self.figures {
            progress(Step::Figure(figure.number));
            let of = |scenario: &Scenario| traces.iter().find(|run| run.scenario == *scenario);
            let runs: Vec<&RunTrace> = figure.scenarios().iter().filter_map(of).collect();
            let sheet = figure.draw(&runs, self.seed, &letters)?;
            let names = ["svg", "png"].map(|kind| format!("figure-{:02}.{kind}", figure.number));
            self.write(&names[0], sheet.svg()?.as_bytes())?;
            self.write(&names[1], &sheet.png(&letters)?)?;
            index.add(figure, &runs, names);
        }
        let text =
            serde_json::to_string_pretty(&index).map_err(|cause| self.error("figures.json", cause.into()))?;
        self.write("figures.json", text.as_bytes())?;
        Ok(index)
    }

    /// One trace of each scenario that is shown.
    fn record(&self, progress: &mut dyn FnMut(Step)) -> Result<Vec<RunTrace>, FigureError> {
        let mut scenarios: Vec<Scenario> =
            self.figures.iter().flat_map(|figure| figure.scenarios()).copied().collect();
        scenarios.sort_unstable();
        scenarios.dedup();
        scenarios
            .into_iter()
            .map(|scenario| {
                let mut report = |ms: u64| progress(Step::Run(scenario, ms));
                RunTrace::of(scenario, self.configuration, self.seed, &mut report)
            })
            .collect()
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), FigureError> {
        std::fs::write(self.out.join(name), bytes).map_err(|cause| self.error(name, cause))
    }

    fn error(&self, name: &str, cause: std::io::Error) -> FigureError {
        FigureError::Folder { path: self.out.join(name), cause }
    }
}
