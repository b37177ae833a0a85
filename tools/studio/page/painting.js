// Work of the program on a painting: its style is fitted, or the page that picks its pairs is opened.
import { api, Refused } from "./api.js";

const look_ms = 400;

// What came of it: the name of a file, or the address of a page. tell(words): what is being done.
export async function work_on(name, painting, tell) {
  await api.painting(name, painting);
  for (;;) {
    const job = await api.job("painting");
    if (job.state === "done") return job.result;
    if (job.state !== "running") throw new Refused(422, job.error ?? { message: "It was cancelled." });
    tell(`${job.stage || "working"} …`);
    await new Promise((resolve) => setTimeout(resolve, look_ms));
  }
}
