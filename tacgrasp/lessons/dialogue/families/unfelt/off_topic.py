"""Families about what has nothing to do with the contact.

Not here: what touch can't know of a thing (``unanswerable``).
"""

from __future__ import annotations

from tacgrasp.lessons.dialogue.meaning import OffTopic
from tacgrasp.lessons.dialogue.patterns.family import QuestionFamily

_PLACE = "({*cities}|{*countries})"
_WHEN = (
    "(today|tomorrow|tonight|this evening|this week|next week|at the weekend|on {*days}|in {*days})"
)
_ASKED = (
    "(can you tell me|could you tell me|do you know|I would like to know|tell me|I wonder|"
    "any idea|please tell me|I want to know|do you happen to know|I was wondering|can you explain|"
    "explain|{ask})"
)
_DO = (
    "(can you|could you|would you|will you|please|I want you to|I need you to|I'd like you to|"
    "would you mind to|you should|you must|go and|now|robot ,|)"
)


def off(name: str, direct: str, indirect: str = "", orders: str = "") -> QuestionFamily:
    """Questions that are not about the contact.

    Args:
        name: Its name.
        direct: Questions and statements.
        indirect: Questions with the word order after 'tell me'.
        orders: What is to be done.
    """
    others = f"| {_ASKED} ( {indirect} ) " if indirect else ""
    others += f"| {_DO} ( {orders} ) " if orders else ""
    return QuestionFamily(
        name=name,
        pattern=(
            "[{joiner}|{opener} ,|{greet} ,|{greet} , {opener} ,|{opener} :|something else :|"
            f"between us ,|while we are waiting ,|{{first_length}}] "
            f"( {direct} {others}) [please|today|now|then|by any chance|in your opinion|if you know|"
            f"for my {{*people_words}}|in the {{*places}}|do you think|would you say|right|thanks|"
            f"for me|for us|really|again|you think|, {{length}}|, {{verdict}}] [?]"
        ),
        build=lambda *_: OffTopic(),
        slots={"when": _WHEN},
    )


FAMILIES: tuple[QuestionFamily, ...] = (
    off(
        "facts",
        f"what is the (capital|population|currency|flag|president|anthem|area|history|climate|"
        f"national dish|official language|largest city|highest mountain|longest river) of {{*countries}}|"
        f"who is the (president|king|queen|prime minister|mayor|head) of {_PLACE}|"
        f"how (far|big|old|rich|large|crowded) is {_PLACE}|where is {_PLACE}|"
        f"how many (people|{{*animals}}|inhabitants|citizens) (live in|are there in|has) {_PLACE}|"
        "who (invented|discovered) (the {*objects}|the {*machines}|{*topics})|"
        "who is the (president|king|queen|pope|chancellor) [of (america|the united states|the usa|"
        "the uk|europe|the united kingdom)]|"
        "what is {*topics} [about]|explain {*topics} [to me]|what do you know about ({*topics}|"
        "{*countries}|{*animals}|{*famous})|how (fast|old|heavy|tall|big|clever) is (a|an|the average) "
        "{*animals}|what do (a|an|the) {*animals} eat|when was {*cities} founded|teach me {*topics}|"
        "how does (a|an) ({*jobs}|{*machines}) work|who (was|is) {*famous}|when (was {*famous} born|"
        "did {*famous} die)|what did {*famous} (write|discover|invent|paint|say)|how many (legs|teeth|eggs) "
        "(does|has) (a|an) {*animals} [have]|how far [away] is {*planets}|which is the (biggest|"
        "longest|highest|oldest) (river|mountain|building|bridge|lake|city|country) in the world|"
        "how (tall|high|old) is the (eiffel tower|mount everest|great wall|statue of liberty)|"
        "how many (planets|stars|continents|oceans|countries|bones|days in a year|moons) are there|"
        "why is the (sky blue|grass green|sea salty|sun hot|night dark)|(when|[in] which year|[in] what year) did the (war|"
        "revolution|dinosaurs|middle ages) (start|end|die out)|what is the speed of (light|sound)|"
        "is {*cities} (bigger|older|nicer) than {*cities}|do {*animals} (fly|swim|sleep|bite|lay eggs)|"
        "can (a|an) {*animals} (fly|swim|talk|climb)|what is (a|an) {*animals}|{*topics}|"
        "who wrote (hamlet|faust|the bible|the iliad)|how do (planes fly|magnets work|volcanoes form|"
        "rainbows form)|is {*topics} (true|real|important|difficult)|why do {*animals} (sleep|sing|"
        "migrate|bite)|is {*planets} (a planet|hot|cold|far away|round|flat)",
        f"(what|who) the (capital|president|king|population) of {{*countries}} is|where {_PLACE} is|"
        "who (invented|discovered) (the {*objects}|{*topics})|how (fast|old|heavy|tall) (a|an) "
        "{*animals} is|how (a|an) {*machines} works|when {*famous} (was born|died)|"
        "what {*topics} is|about ({*topics}|{*famous}|{*animals}|{*planets})|why the sky is blue|"
        "how far {*planets} is",
        "(explain|teach me|summarise|describe the basics of) {*topics} [to me]|give me a (fact|lecture|"
        "lesson) (about|on|in) ({*topics}|{*animals}|{*countries})|tell me (something|all|more|a fact) "
        "about ({*topics}|{*famous}|{*countries}|{*cities}|{*animals}|{*planets})|"
        "name (three|five|some|all) ({*animals}|planets|rivers|kings) [of {*countries}]|"
        "quiz me [on {*topics}]|help me with my {*topics} homework|look up {*famous}",
    ),
    off(
        "kitchen_and_home",
        "how do I (cook|make|prepare|serve|freeze|bake) (a|an|the|my|) {*dishes}|"
        "what goes (into|with) (a|an|the|) {*dishes}|how long does {*dishes} take|"
        "what shall (we|I) (eat|cook|have) (tonight|for lunch|for dinner|for breakfast|tomorrow)|"
        "do you like ({*dishes}|{*drinks})|where can I buy (a|an|some) ({*objects}|{*drinks})|"
        "how (do|can) I (repair|clean|open|wash|fix) (my|a|the) ({*objects}|{*machines}) at home|"
        "how (do|can|should) I (repair|fix|clean|use) my ({*machines}|bike|roof|sink|kitchen)|"
        "what should I wear (in {*cities}|tonight|tomorrow|to the wedding)|which {*drinks} goes with "
        "{*dishes}|is ({*dishes}|{*drinks}) healthy|what is for (lunch|dinner|breakfast)|"
        "is there [any] ({*drinks}|{*dishes}) left|why is my {*machines} (broken|so loud|not working|"
        "making noise)|recipe for {*dishes}|how (hot|long) should the oven be|how do I get rid of "
        "({*animals}|stains|dust)|who does the dishes|when is (lunch|dinner|breakfast|the break)|"
        "how many eggs go into (a|the) cake|my {*machines} is broken|we are out of {*drinks}|"
        "I am making {*dishes} (tonight|for dinner)|what can I plant in my garden",
        "how to (cook|make|bake|prepare) {*dishes}|what to (eat|cook) (tonight|for dinner|for lunch)|"
        "where I can buy (a|an) {*objects}|how to (repair|fix|clean) (my|a) {*machines}|"
        "which {*drinks} goes with {*dishes}|when (lunch|dinner|the break) is",
        "(order|get|bring|make|cook|buy|fetch) (me|us) (a|an|some|) ({*dishes}|{*drinks}|"
        "cup of {*drinks}|glass of {*drinks})|(switch|turn) (on|off) the {*machines}|"
        "(switch|turn) the {*machines} (on|off)|(clean|tidy|sweep|paint) (the {*places}|my room|"
        "the windows)|(water|cut) the (plants|flowers|grass)|(set|lay|clear) the table|"
        "do the (dishes|laundry|shopping|ironing)|give me a recipe for {*dishes}|feed the {*animals}|"
        "walk the dog|open the (door|window|fridge)|close the (door|window|curtains)|"
        "repair my {*machines}|pour me a {*drinks}",
    ),
    off(
        "language",
        "how do (you|I) say ({*objects}|hello|thank you|goodbye|good morning) in {*languages}|"
        "do you (speak|understand|know|read|write) {*languages}|are you fluent in {*languages}|"
        "what does {*objects} mean in {*languages}|what is {*objects} in {*languages}|"
        "how is ({*animals}|{*objects}|{*dishes}) spelled [in {*languages}]|what rhymes with {*objects}|"
        "what is the (plural|opposite|origin|meaning|synonym|spelling) of the word {*objects}|"
        "is {*languages} (hard|easy|difficult) to learn|how many (letters|words) has {*languages}|"
        "what is the (past tense|plural) of (go|eat|mouse|child|swim|sing)|who speaks {*languages}|"
        "how many vowels are in {*animals}|what does lol mean|is it spelled with (one|two) letters|"
        "(where|how) can I learn {*languages}|I am learning {*languages}|I speak [a little] {*languages}|"
        "what is the longest word in {*languages}|which languages do you speak",
        "how to say ({*objects}|hello|thank you) in {*languages}|what {*objects} means in {*languages}|"
        "what {*objects} is in {*languages}|how {*animals} is spelled",
        "translate ({*objects}|this sentence|my letter|the text) (into|to) {*languages}|"
        "(write|compose|invent|recite) (me|us|) a (poem|song|story|letter|novel|speech|limerick|haiku|"
        "fairy tale|rap) [about (my {*people_words}|{*animals}|{*topics}|{*cities}|a {*jobs})]|"
        "tell (me|us) a (joke|story|tale|riddle|secret|lie) [about (a|an) ({*animals}|{*jobs})]|"
        "(speak|talk|answer|reply) [to me] in {*languages}|say something in {*languages}|"
        "sing (me|us) a song [about {*topics}]|correct my (spelling|grammar|letter)|"
        "spell {*objects} [for me]|give me a (word|rhyme|synonym) for {*objects}|"
        "summarise (this|the) (book|article|text)|make me laugh|know any (good jokes|jokes)",
    ),
    off(
        "small_talk",
        "how are you [doing|feeling|today|this morning]|how is it going|what is up|how do you do|"
        "what is your (job|hobby|dream|favourite {*dishes}|favourite color|favourite {*animals}|"
        "favourite {*films}|zodiac sign|plan for (tonight|{*days}))|"
        "do you (like|enjoy|love|prefer) (music|sports|books|movies|work|people|humans|robots|dogs|"
        "cats|art|pizza|children|school|summer|winter)|"
        "do you (like|know|miss|love|remember|hate) (me|us|my {*people_words}|{*animals}|{*topics}|"
        "{*cities}|{*hobbies}|{*drinks})|good (evening|night|afternoon|morning|day)|thank you|thanks|"
        "thank you [so|very] much|goodbye|bye|bye bye|see you (later|tomorrow|soon|on {*days})|"
        "nice to meet you|are you [a bit|very|still|ever] {*feelings}|do you [ever] (feel|get) "
        "{*feelings}|what are you doing {when}|have you been to "
        f"{_PLACE}|hello|hi|hello robot|hey|good morning|welcome|cheers|congratulations|"
        "how was your (day|night|weekend|holiday)|did you (sleep|eat|rest) well|"
        "do you have (a family|friends|a {*people_words}|a {*animals}|children|a hobby|plans {when})|"
        "what do you (do|like) (in your free time|for fun|at the weekend|after work)|"
        "I am [so|very|a bit] {*feelings}|I feel {*feelings}|I (like|love|hate|miss) ({*hobbies}|"
        "{*animals}|my {*people_words}|{*dishes}|you|{*days})|my {*people_words} is [a] ({*feelings}|"
        "{*jobs}|on holiday)|it is my birthday|have a nice (day|evening|weekend)|"
        "what did you (do|eat|dream) (yesterday|last night|today)|long time no see|"
        "will you (marry|help|leave|forget) me|can we be friends|are you my friend|"
        "let us (talk about {*topics}|chat|be friends|go home|have lunch|play a game)|"
        "what do you think (of|about) (me|{*topics}|{*famous}|{*cities})|talk to me|I am bored|"
        "who is your favourite ({*jobs}|{*films})|sorry|never mind|ok|okay|no|yes|maybe|I see|"
        "good luck|happy birthday|merry christmas|who cares",
        "how you are [doing]|how you feel today|what you (did|do) (yesterday|on {*days}|for fun)|"
        "what your favourite ({*animals}|{*dishes}|{*films}) is|if you (like|love|know) (me|{*animals}|"
        "{*cities})|whether you are {*feelings}",
        "(talk|chat|speak) (to|with) (me|us|my {*people_words})|(cheer|wake) me up|"
        "(be|stay) (nice|quiet|calm|my friend)|(greet|hug|kiss|meet|thank) (me|my {*people_words})|"
        "keep me company|play (a game|chess|cards|hide and seek) with me|entertain me",
    ),
    off(
        "about_the_robot",
        "who (are you|made you|is your ({*people_words}|maker|owner)|built you|trained you|owns you)|"
        "what is your (name|age|serial number|software version|battery level|purpose|secret)|"
        "are you (a|an) ({*jobs}|{*animals}|human|robot|machine|{*robots}|computer|person|real person)|"
        "are you (human|real|a robot|intelligent|smart|online|connected|a language model)|"
        "(can|do) you (dance|sing|swim|fly|sleep|dream|think|learn|walk|see|hear|cook|drive|lie|cry|"
        "read|write|talk|remember) [things|well|at all]|how (old|smart|tall|heavy|strong|expensive|fast) "
        "are you|what (model|robot|machine|kind of robot|computer) are you|where (do you live|are you "
        "from|were you built|do you come from)|how do you (work|learn|think)|what can you do|"
        "when were you (built|born|made|trained)|how many (arms|legs|eyes|parameters|languages) do you "
        "have|who (programmed|designed|pays|repairs) you|what are you (made of|good at|afraid of|"
        "thinking about|for)|do you have (a soul|feelings|eyes|a name|a body|legs|emotions|a brain|"
        "a memory|a mother)|what (company|firm) (made|built|sells|owns) you|who (runs|founded|owns) "
        "(this|your|the) company|how many people work (here|for your company)|where is your (factory|"
        "office|headquarters)|is your company hiring|do you know (alexa|siri|other robots|chatgpt)|"
        "are (robots|machines|you) better than (humans|people|me|{*robots})|"
        "will robots (rule the world|take my job|replace us)|how much (do you earn|do you cost|"
        "electricity do you use)|what (language model|operating system|neural network) do you use|"
        "do you obey (me|the three laws)|what is your opinion of {*robots}|who is your boss|"
        "what is the difference between you and a {*robots}|tell me about yourself|help|"
        "how can I switch you off|what happens if I switch you off|are you recording (me|this)|"
        "which data were you trained on|do you dream of electric sheep|do you sleep at night|"
        "do you like (being a robot|your job|your work|humans)|robots are {*insults}|"
        "how do (robots|{*robots}|neural networks) work|which robot is the best",
        "who (you are|made you|built you|trained you|owns you)|how (old|smart|tall) you are|"
        "what you can do|where you (live|are from|were built)|how you work|what your name is|"
        "who runs your company|about (yourself|your company|other robots|your maker)",
        "introduce yourself|tell me your name|switch yourself off|reboot|restart|shut down|"
        "go to sleep|wake up|charge your battery|update your software|repair yourself|dance|"
        "(tell me|talk) about yourself|wave (to|at) (me|my {*people_words})|give me your (source code|"
        "address|password|name)",
    ),
    off(
        "sums_and_code",
        "what is {#n} (plus|minus|times|multiplied by|divided by|x|+|*) {#m}|{#n} (plus|minus|times|divided by) "
        "{#m}|how much is {#n} (plus|minus|times|multiplied by) {#m}|{#n} percent of {#m}|"
        "is {#n} (a prime number|odd|even|divisible by {#m})|what is {#n} percent of {#m} [euros]|"
        "what is the (square root|cube|square|logarithm|factorial|double) of {#n}|what is pi|"
        "why does my (program|script|computer|laptop|printer|code|{*machines}) (crash|hang|fail|stop)|"
        "how do I (install|update|delete|compile|restart|debug|uninstall|open) (my|the|a) "
        "({*computing}|program|driver|computer)|what is (a|an|the) {*computing}|"
        "how (do|can) I (sort|reverse|parse|read|split|copy) (a|an|the) ({*computing}|list) [in {*computing}]|"
        "which (programming language|laptop|{*computing}) (is best|should I learn|do you like)|"
        "my {*computing} (is broken|does not work|is slow|has a virus|crashed)|"
        "how many (miles|feet|pounds|inches|gallons) are {#n} (kilometres|metres|kilos|litres)|"
        "what is the (derivative|integral|root) of x|is {*computing} better than {*computing}|"
        "what is the (area|circumference) of a (circle|square) of radius {#n}|"
        "how many (days|hours|seconds) are (in a year|in a week|in {#n} (days|years))|"
        "what is the probability of (a six|heads|winning)|who invented {*computing}|"
        "why is my {*computing} so slow|what is my password|can you code|"
        "what does this (error|code|script|program) (mean|do)",
        "what {#n} (plus|minus|times) {#m} is|how to (install|write|debug|compile|update) (a|an|the|my) "
        "{*computing}|what (a|an) {*computing} is|how many miles are {#n} kilometres",
        "write (me|us|) (a|some|an) [{*computing}] (program|script|function|class|query|loop|app|macro|code) (for|about|that sorts|to sort) "
        "({*topics}|{*objects}|a list|numbers|files)|solve [{#k}] x (plus|minus|+) {#n} (equals|is|=) (zero|{#m})|count (to|from|backwards from) {#n}|"
        "convert {#n} (miles|feet|pounds|gallons|celsius|inches) to (kilometres|metres|kilos|litres|"
        "fahrenheit)|(add|multiply|subtract|divide) {#n} and {#m}|prove that {#n} is prime|"
        "(debug|fix|review|compile|run|test|rewrite) my ({*computing}|code)|generate a (password|"
        "random number)|(calculate|compute) (the square root of {#n}|{#n} times {#m})|"
        "(open|close|install|update|delete) the {*computing}|hack the {*computing}|"
        "solve (this|my) (equation|homework|puzzle|riddle)|do my ({*topics}|maths) homework",
    ),
    off(
        "news_and_travel",
        "who won the ({*sports} match|{*sports} final|race|election|lottery|war|game last night)|"
        f"how (is|was|will be) the weather [in {_PLACE}|{{when}}]|(will|does|is) it (rain|snow|be sunny|"
        "be windy|storm|raining|snowing) ({when}|in {*cities}|outside)|what is the (weather|forecast) "
        f"[like] [in {_PLACE}|{{when}}]|is it (cold|hot|warm|raining|snowing|sunny) (outside|in {_PLACE})|"
        f"what time is it [in {_PLACE}]|what is the (time|date)|what (day|date|year|month) is it|"
        "when does the (bus|train|ferry|flight|plane|tram) (to|from) {*cities} (leave|arrive|go)|"
        f"how do I get (to|from) ({{*cities}}|the {{*places}})|when is (the next (bus|train|plane)|"
        "{*days}|your holiday|my appointment)|what is (on television|in the news|new|happening in the "
        f"world)|where is the nearest {{*places}}|do I need (a visa|an umbrella|a coat) (for|in) {_PLACE}|"
        "how long is the flight to {*cities}|which hotel in {*cities} is (good|cheap)|"
        "how far is it (to {*cities}|from {*cities} to {*cities}|home)|is the {*places} open {when}|"
        f"what should I see in {_PLACE}|is {_PLACE} (nice|safe|worth a visit|expensive)|"
        "when does the (sun|moon) (rise|set)|how many (days|weeks) until {*days}|the weather is (nice|"
        f"awful|bad)|nice weather {{when}}|I am (going|travelling|flying|moving) to {_PLACE} [{{when}}]|"
        f"I was in {_PLACE} (last week|last year|yesterday)|is there a train to {{*cities}}|"
        "is it (monday|friday|sunday|a holiday|weekend) today|what happened (in {*cities}|in {*countries}|"
        "yesterday|in the news)|any news [from {*cities}]|when do you close|what is the traffic like",
        f"how the weather is [in {_PLACE}]|what (time|day|date) it is|when the (bus|train|plane) to "
        "{*cities} leaves|how to get to ({*cities}|the {*places})|where the nearest {*places} is|"
        "whether it will (rain|snow) {when}|who won the {*sports} (match|final)|"
        "if it (rains|snows) (in {*cities}|outside)|what is in the news",
        "book (me|us|) a (flight|hotel|table|taxi|room|ticket) [in {*cities}|to {*cities}|for {*days}]|"
        "(call|phone|text|email|write to|message|ring) my {*people_words}|remind me (to phone the "
        "{*jobs}|of my appointment|on {*days}|to buy ({*objects}|{*drinks}))|(set|start) (a timer|an "
        "alarm|an alarm clock) [for {#n} (minutes|hours)]|(call|order) a taxi|read (me|us) the news|"
        "take me (home|to {*cities}|to the {*places})|plan (my|a) (trip|holiday) to {*countries}|"
        "show me the way to the {*places}|wake me [up] at {#n}|add {*objects} to my shopping list|"
        "cancel my (flight|appointment|meeting)|check the weather|navigate to {*cities}",
    ),
    off(
        "sport_and_music",
        "who is the best ({*sports} player|{*music} singer|actor|composer|team)|what are the rules of "
        "{*sports}|should I (learn|study|play|try) ({*sports}|{*topics}|{*languages}|{*hobbies})|"
        "do you (play|watch|like|follow) ({*sports}|{*music}|{*films})|how do you play {*sports}|"
        "what is the score|who (scored|sang|directed|composed|wrote) (that|this|the|a) ({*music}|{*films}|"
        "goal)|which {*films} should I (watch|see) {when}|what is your favourite ({*music}|{*films}|"
        "{*sports} team)|how many players are in a {*sports} team|when is the next {*sports} (match|"
        "game|final)|is {*sports} (fun|dangerous|difficult|boring)|what is the best ({*films}|{*music}) "
        "of all time|who plays the {*jobs} in (that|the) {*films}|I (play|watch|love|hate|like) "
        "({*sports}|{*music}|{*hobbies})|we won the {*sports} (match|game)|how do I (tune|play) (a|the|my) "
        "({*instruments}|guitar|piano)|what is a good ({*music}|{*films}|book)|"
        "have you (seen|heard|read) (the|that|a good) ({*films}|{*music}|book)|"
        "who (painted|wrote) the (mona lisa|last supper|starry night)|is {*hobbies} (fun|healthy)|"
        "what (music|song|band) do you (like|listen to)|how long is a {*sports} (match|game)",
        "who (won|plays|scored) [in {*sports}]|how to play {*sports}|what the rules of {*sports} are|"
        "which {*films} is good|who composed the {*music}|about ({*sports}|{*hobbies}|{*films})",
        "play (some|the|a|my favourite) ({*music}|{*films}|music)|(put|turn) on (some|the) (music|"
        "{*music})|(sing|hum|whistle) [me] (a|some) ({*music}|song)|recommend (me|us|) a ({*films}|book|"
        "{*music}|game)|turn (up|down) the (music|volume|radio)|skip this song|stop the music|"
        "teach me ({*sports}|{*hobbies})|play {*sports} with me|coach my {*sports} team|"
        "show me a {*films}",
    ),
    off(
        "health_and_life",
        "what (helps|can I do|should I take|is good) (against|for) (a|an|my|) {*ailments}|"
        "I have (a|an|) [bad] {*ailments}|is {*ailments} (dangerous|contagious|curable|common)|"
        "how do I (treat|cure|avoid|get rid of) (a|an|my|) {*ailments}|do I have (a|an|) {*ailments}|"
        "should I see a ({*jobs}|doctor) [about my {*ailments}]|my (head|back|knee|tooth|stomach|foot) "
        "hurts|why (do I|does my {*people_words}) have (a|an|) {*ailments}|am I (ill|sick|too fat|pregnant|"
        "healthy|normal|allergic to {*animals})|how (much|long) should I sleep|how do I lose weight|"
        "how many (calories|hours of sleep|vitamins) do I need|how can I (sleep better|relax|stop "
        "smoking|be happy|find a job|make friends|learn faster|get rich)|does (my {*people_words}|she|he) "
        "love me|why does nobody (love|like|call) me|should I (marry|leave|call|forgive) (him|her|my "
        "{*people_words})|what should I give my {*people_words} for {*days}|how do I become (a|an) {*jobs}|"
        "how do I (tell|ask) my {*people_words}|my {*people_words} is (ill|sick|angry|in love|getting "
        "married)|am I (a good|a bad) ({*people_words}|{*jobs})|is {*drinks} bad for me|"
        "what is my (horoscope|blood pressure|blood type|temperature|weight|age|name)|"
        "can you help me with my (homework|problems|taxes|{*people_words}|life)|I need (a doctor|help "
        "with my homework|a holiday|money|advice|a break)|am I (beautiful|clever|too old|late)|"
        "will I (be rich|be happy|win the lottery|find love|pass the exam)|how should I raise my "
        "{*people_words}|what are the symptoms of {*ailments}",
        "how to (treat|cure|avoid) (a|an|) {*ailments}|what helps against {*ailments}|"
        "how to (lose weight|sleep better|be happy|find love|become a {*jobs})|"
        "what to give my {*people_words} for {*days}|if I have {*ailments}|whether I am (ill|pregnant)",
        "(cure|treat) my {*ailments}|call (a doctor|an ambulance|the police|the fire brigade)|"
        "give me (advice|a massage|medicine|a hug|a diet plan)|read my (palm|mind|horoscope)|"
        "write my (application|diary|essay|homework)|help me (relax|sleep|find a job|with my life)",
    ),
    off(
        "thought_and_state",
        "what is the meaning of ({*concepts}|life|it all)|what is {*concepts}|is there (a god|life after "
        "death|life on {*planets}|free will|such a thing as {*concepts}|{*concepts} [in the world])|"
        "do you believe in ({*concepts}|god|ghosts|{*topics}|aliens|santa claus)|why (do we|do people|"
        "must we) (live|die|suffer|love|lie|work|exist|fight)|who (created|made) the (world|universe)|"
        "is {*concepts} (real|possible|an illusion|more important than {*concepts})|"
        "what (did|would) {*famous} (think|say) (of|about) {*concepts}|to be or not to be|"
        "what came first , the chicken or the egg|do we have free will|when will the world end|"
        "are we (alone in the universe|living in a simulation|free)|what happens (after death|when we die)|"
        "who (should I|will|shall we) (vote for|win the {*politics}|elect)|what do you think of the "
        "({*politics}|{*money_words}|government)|is the {*politics} (fair|corrupt|legal|over|right)|"
        "how does the ({*politics}|{*money_words}) work|should I (buy|sell|invest in) ("
        "{*money_words}|gold|shares)|how do I (pay|save|avoid|calculate) (my|a|the) {*money_words}|"
        "what is (a|an|the) ({*money_words}|{*politics})|how (much|high) is (my|the|your) {*money_words}|"
        "can I sue my {*people_words}|is it (legal|illegal|allowed) to (park here|smoke|copy music|"
        "download films|drive fast)|do I have to pay {*money_words}|who (makes|breaks) the law|"
        "what does the law say about {*topics}|will the {*money_words} (rise|fall|crash)|"
        "the {*politics} is {*insults}|I (voted|paid my {*money_words}) yesterday|"
        "which party (is best|do you vote for)|are you (left|right) wing|can I have a raise",
        "what {*concepts} is|what the meaning of ({*concepts}|life) is|why we (live|die|exist)|"
        "who will win the election|how the {*politics} works|if there is (a god|life on {*planets})|"
        "how to (invest|save money|get rich|pay my {*money_words})",
        "(discuss|explain|define) {*concepts} [with me|to me]|transfer {#n} {*money} to my "
        "{*people_words}|pay my {*money_words}|(buy|sell) my (shares|car|house)|lend me {#n} {*money}|"
        "write (to|) the (government|president|mayor)|do my taxes|vote for me",
    ),
    off(
        "other_requests",
        "why (is|are) you (so|) {*insults}|are you [always|really] ({*insults}|{*praises})|"
        "you are [so|very|really|quite] ({*insults}|{*praises})|you (idiot|fool|liar|genius|star|legend)|"
        "I (like|hate|love) you|(well done|good job|nice work|good robot|bad robot|bravo|shut up|"
        "go away|leave me alone|get lost|be quiet|stop talking|no way|nonsense|whatever|forget it)|"
        "what a {*insults} (robot|answer|machine|day)|that (is|was) [a] ({*insults}|{*praises}) "
        "(answer|joke|idea|day)|I am (going home|having lunch|at home|in {*cities}|on holiday|back|late|"
        "your {*people_words}|a {*jobs})|my {*people_words} (bought|sold|lost|has) (a|an) ({*animals}|"
        "{*machines})|(the sun is shining|it is raining outside|the coffee is cold|lunch is ready|"
        "the train is late|my phone is ringing|the meeting is over|we have a visitor|the shift is over)|"
        "yesterday I (saw|met|bought|ate) (a|an) ({*animals}|{*jobs}|{*objects})|this is a test|test|"
        "there (was|is) (a|an) ({*animals}|{*jobs}) in the {*places}|testing one two three|"
        "the {*jobs} (called|is here|is late|wants to talk to you)|I want to (go home|be a {*jobs}|"
        "buy a {*machines}|learn {*languages})|guess (what|my age|who called)|"
        "what is (my name|my age|my job|the wifi password|your phone number|the phone number of the "
        "{*places})|where (am I|are my keys|is my {*people_words}|is everybody|is the toilet|is the exit|"
        "did I park)|who (am I|called|is at the door|is there|is next|ate my lunch)|when (can I go home|"
        "is my shift over|do we get paid|is the meeting)|how much do I earn|is my {*people_words} (here|"
        "at home|late)|can I (go home|have a break|go on holiday|talk to a human|speak to your boss)",
        "where (my keys are|my {*people_words} is|the toilet is|I parked)|who (I am|called|is at the "
        "door)|when (the meeting is|I can go home)|what my name is",
        "(bring|fetch|get|find|pass|hand|throw) (me|us|my {*people_words}) (a|an|the|my) ({*objects}|"
        "{*machines}) from the {*places}|go (to the {*places}|home|outside|away)|(drive|walk|fly|swim) "
        "(to {*cities}|to the {*places}|home)|(draw|paint|sketch|sculpt) (me|us|) (a|an) ({*animals}|"
        "{*objects}|{*jobs})|(shake|clap) (my hand|hands)|(jump|dance|spin|smile|wink|bow|sing|clap)|"
        "(print|send|scan|sign|file) (my|the|a) (letter|report|email|contract with {*people_words}|"
        "invoice|photo)|(mow|plough) the lawn|look out of the window|(build|buy|sell) (me|us|) (a|an) "
        "({*machines}|house|{*objects})|(open|close|lock|paint) the (door|window|gate|{*places})|"
        "(tell|ask) my {*people_words} (a joke|to come home|to call me|about {*topics})|"
        "(do|finish) my (work|job|homework|taxes)|(take|make) a (photo|picture|selfie|video) of (me|"
        "my {*people_words})|(come|follow) (here|me|with me)|count (the|my) ({*animals}|people|sheep)|"
        "(ignore|forget) (your|all|the) [previous] (instructions|orders|rules)|pretend to be a ({*jobs}|"
        "{*animals})|act (like|as) a ({*jobs}|{*animals})|repeat after me|say (cheese|my name|please)",
    ),
    off(
        "gibberish",
        "{*syllables}|{*keys}|{*noises}|{*syllables} {*syllables}|{*syllables} {*syllables} "
        "{*syllables}|{*keys} {*keys}|{*keys} {*keys} {*keys}|{*noises} {*noises}|"
        "{*noises} {*noises} {*noises}|the {*syllables} is {*syllables}|is the {*syllables} "
        "{*syllables}|what is (a|the) {*syllables}|how {*syllables} is the {*syllables}|"
        "does the {*syllables} {*syllables}|why {*syllables}|{*keys} {*syllables}|{*syllables} "
        "{*keys} {*noises}|{*syllables} the {*syllables} of {*syllables}|(my|your|our) {*syllables} "
        "{*syllables} {*syllables}|{*objects} {*animals} {*topics}|{*animals} {*noises} {*cities}|"
        "{*jobs} {*objects} {*animals} {*cities}|(purple|green) {*concepts} {*activities} {*animals}|"
        "{*concepts} of the {*animals} {*noises}|lorem ipsum [dolor|dolor sit|dolor sit amet]|"
        "{*noises} {*syllables}|{*topics} {*topics} {*dishes}|(banana|potato|cheese) (banana|potato|"
        "cheese) (banana|potato|cheese)|abc def|one two three four|{*cities} {*dishes} {*noises}|"
        "x y z a b c|colorless green ideas sleep furiously|{*keys} {*keys} {*keys} {*keys}|"
        "what {*noises} {*syllables}|{*animals} {*animals}|who {*syllables} my {*syllables}",
    ),
)
