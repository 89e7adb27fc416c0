use std::process::Child;

/// A process that ends with the test that started it, also when the test fails.
#[derive(Debug)]
pub struct EndedWithTest(pub Child);

impl Drop for EndedWithTest {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}
